#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/text.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/video/outline_distance.h"
#include "stylizer/commands.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

constexpr int kCell_px = 150, kMostKeys = 12;

void drawBones(Image& image, const Eigen::VectorXd& pose, const SkeletonTemplate& plan, double width_px) {
  for (std::size_t j = 0; j < plan.joints.size(); ++j)
    if (const int parent = plan.joints[j].parent; parent >= 0)
      drawLine(image, pose.segment<2>(2 * parent), pose.segment<2>(2 * Eigen::Index(j)), width_px,
               sideColor(plan.joints[j].name));
}

// The unit box as a cell.
Image stickFigure(const Eigen::VectorXd& pose, const SkeletonTemplate& plan) {
  Image cell = blankImage(kCell_px, kCell_px);
  drawBones(cell, pose * (kCell_px - 1.), plan, 3);
  return cell;
}

// The frame's picture with its joints, or the joints alone.
Image keyPicture(const MotionFrame& frame, const Eigen::VectorXd& pose, const std::string& motion,
                 const SkeletonTemplate& plan) {
  // What the file says of its frames need not be so.
  constexpr int kMost_px = 4000;
  const double scale = std::min(1., double(kMost_px) / std::max(frame.image_width, frame.image_height));
  const auto scaled = [&](int side) { return std::max(1, int(std::lround(scale * side))); };
  Image image = blankImage(scaled(frame.image_width), scaled(frame.image_height));
  if (!frame.image_file.empty()) {
    const Image picture = readImage((fs::path(motion).parent_path() / frame.image_file).string());
    blit(image, resized(picture, scaled(picture.width), scaled(picture.height)), 0, 0);
  }
  drawBones(image, scale * pose, plan, std::max(image.width, image.height) / 90.);
  return fitted(image, kCell_px, kCell_px);
}

// Distances between the outlines of the frames' pictures, or between poses where there are none; of a long
// motion's, `most` frames.
Eigen::MatrixXd distances(const MotionFile& motion, const std::string& path, const PoseMatrix& poses,
                          std::size_t most) {
  const std::size_t all = motion.frames.size(), count = std::min(all, most);
  const auto frame = [&](std::size_t i) { return i * all / count; };
  const bool pictures = std::none_of(motion.frames.begin(), motion.frames.end(),
                                     [](const MotionFrame& f) { return f.image_file.empty(); });
  if (pictures) {
    std::vector<FrameOutline> outlines(count);
    parallelFor(count, 0, [&](std::size_t i) {
      const std::string& file = motion.frames[frame(i)].image_file;
      const Image image = readImage((fs::path(path).parent_path() / file).string());
      const Silhouette figure = extractSilhouette(image);
      outlines[i] = outlineOf(figure.found() ? figure.mask : Plane8(Plane8::Zero(image.height, image.width)));
    });
    return distanceMatrix(outlines);
  }
  Eigen::MatrixXd matrix(count, count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      matrix(Eigen::Index(a), Eigen::Index(b)) =
          (poses.col(Eigen::Index(frame(a))) - poses.col(Eigen::Index(frame(b)))).norm();
  return matrix;
}

Image heatPicture(const Eigen::MatrixXd& values, int width, int height) {
  Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> field(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      field(y, x) = float(values(y * values.rows() / height, x * values.cols() / width));
  return heatMap(field + 1e-6f);  // 0 is dark, not clear
}

}  // namespace

ExitCode runInspect(const InspectOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  const MotionFile motion = readMotionFile(options.motion, plan);
  const PoseMatrix poses = posesOf(motion, plan, options.motion), canonical = canonicalPoses(poses, plan);
  SparseCodingOptions coding = options.coding;
  coding.components = std::min(coding.components, int(canonical.cols()));
  const SparseCoding style = sparseCoding(canonical, coding);

  std::vector<int> keys;
  for (std::size_t f = 0; f < motion.frames.size(); ++f)
    if (motion.frames[f].key) keys.push_back(int(f));
  std::vector<Panel> key_panels;
  const std::size_t shown = std::min<std::size_t>(keys.size(), kMostKeys);
  for (std::size_t i = 0; i < shown; ++i) {
    const int f = keys[i * keys.size() / shown];
    key_panels.push_back({keyPicture(motion.frames[std::size_t(f)], poses.col(f), options.motion, plan),
                          "frame " + std::to_string(f + 1)});
  }
  std::vector<Panel> basis_panels;
  // A component alone is a pose of the canonical box at the size that its mean activation gives it, around
  // the mean pose.
  const Eigen::VectorXd mean = canonical.rowwise().mean();
  for (Eigen::Index c = 0; c < style.basis.cols(); ++c) {
    const Eigen::RowVectorXd v = style.activations.row(c);
    const double swing = v.maxCoeff() - v.mean();
    basis_panels.push_back(
        {stickFigure((mean + swing * style.basis.col(c)).cwiseMin(1.2), plan), "U" + std::to_string(c + 1)});
  }
  const int side = 3 * kCell_px;
  const std::vector<Panel> maps = {
      {heatPicture(distances(motion, options.motion, poses, side), side, side), "distance between frames"},
      {heatPicture(style.activations, 2 * side, side), "components over time"}};
  std::vector<Panel> rows;
  if (!key_panels.empty()) rows.push_back({montage(key_panels, {.columns = 6}), "key frames"});
  rows.push_back({montage(maps), ""});
  rows.push_back({montage(basis_panels, {.columns = 8}), "mean pose with each component at its most"});
  writeFile(options.output, encodePng(montage(rows, {.columns = 1})));
  std::printf("%s: %d frames, %d components, off by %.2f %%\n", printable(options.output).c_str(),
              int(poses.cols()), coding.components, 100 * style.error);
  return ExitCode::kDone;
}

}  // namespace skel
