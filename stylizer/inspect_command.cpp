#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>

#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/video/formats.h"
#include "libskel/video/outline_distance.h"
#include "libskel/video/video_reader.h"
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

// The frame's picture, which may be empty, with its joints. The picture was so many `times` as large.
Image keyPicture(const MotionFrame& frame, const Image& picture, double times, const Eigen::VectorXd& pose,
                 const SkeletonTemplate& plan) {
  // What the file says of its frames need not be so.
  const double scale =
      std::min(1 / times, double(kLongestFrameSide_px) / std::max(frame.image_width, frame.image_height));
  const auto scaled = [&](int side) { return std::max(1, int(std::lround(scale * side))); };
  Image image = blankImage(scaled(frame.image_width), scaled(frame.image_height));
  if (!picture.empty()) {
    const auto shown = [&](int side) { return std::max(1, int(std::lround(scale * times * side))); };
    blit(image, resized(picture, shown(picture.width), shown(picture.height)), 0, 0);
  }
  drawBones(image, scale * pose, plan, std::max(image.width, image.height) / 90.);
  return fitted(image, kCell_px, kCell_px);
}

// So many of `all`, evenly; all if they are fewer.
std::vector<int> spreadOver(std::size_t all, std::size_t most) {
  std::vector<int> some(std::min(all, most));
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = int(i * all / some.size());
  return some;
}

// What is shown of frames that have pictures, by the frames' numbers.
struct Pictures {
  std::map<int, Image> keys;
  std::vector<FrameOutline> outlines;  // of each file
  std::map<int, int> outline_of;       // of each frame, an index into these
};

// Reads each file once, whichever frames name it, and holds one picture in full at a time.
Pictures lookAtPictures(const MotionFile& motion, const std::string& path, const PoseMatrix& poses,
                        const SkeletonTemplate& plan, const std::vector<int>& keys,
                        const std::vector<int>& outlined) {
  struct Use {
    std::vector<int> keys, outlined;
  };
  std::map<fs::path, Use> uses;
  const auto note = [&](const std::vector<int>& frames, std::vector<int> Use::*use) {
    for (const int f : frames)
      if (const std::string& file = motion.frames[std::size_t(f)].image_file; !file.empty())
        (uses[fs::weakly_canonical(fs::path(path).parent_path() / file)].*use).push_back(f);
  };
  note(keys, &Use::keys);
  note(outlined, &Use::outlined);
  const std::vector<std::pair<fs::path, Use>> files(uses.begin(), uses.end());
  Pictures pictures;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const int f : files[i].second.outlined) pictures.outline_of[f] = int(i);
  pictures.outlines.resize(files.size());
  std::mutex reading;
  ProgressBar bar("pictures", files.size());
  parallelFor(files.size(), 0, [&](std::size_t i) {
    const auto& [file, use] = files[i];
    Image image;
    double times = 1;
    {
      const std::lock_guard lock(reading);
      Image whole = readImage(file.string());
      const int width = whole.width;
      image = shrunk(std::move(whole));
      times = double(width) / image.width;
      for (const int f : use.keys)
        pictures.keys[f] = keyPicture(motion.frames[std::size_t(f)], image, times, poses.col(f), plan);
    }
    if (!outlined.empty()) {
      const Silhouette figure = extractSilhouette(image);
      pictures.outlines[i] =
          outlineOf(figure.found() ? figure.mask : Plane8(Plane8::Zero(image.height, image.width)));
    }
    bar.advance();
  });
  return pictures;
}

// Distances between the frames' outlines, or between their poses where not all have one of the same size.
Eigen::MatrixXd distances(const std::vector<int>& frames, const Pictures& pictures, const PoseMatrix& poses) {
  const std::vector<FrameOutline>& outlines = pictures.outlines;
  const bool same_size = std::all_of(outlines.begin(), outlines.end(), [&](const FrameOutline& outline) {
    return outline.width == outlines[0].width && outline.height == outlines[0].height;
  });
  if (!pictures.outline_of.empty() && same_size) {
    ProgressBar bar("distances", outlines.size());
    const Eigen::MatrixXd of_files = distanceMatrix(outlines, 0, [&] { bar.advance(); });
    std::vector<int> of_frames;
    for (const int f : frames) of_frames.push_back(pictures.outline_of.at(f));
    return of_files(of_frames, of_frames);
  }
  const PoseMatrix some = poses(Eigen::all, frames);
  Eigen::MatrixXd matrix(some.cols(), some.cols());
  for (Eigen::Index f = 0; f < some.cols(); ++f)
    matrix.col(f) = (some.colwise() - some.col(f)).colwise().norm();
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
  const MotionFile motion = readMotion(options.motion);
  const PoseMatrix poses = posesOf(motion, plan, options.motion);
  // Of a long motion, as many frames as make a style, and as many as the map has pixels.
  const int side = 3 * kCell_px;
  const std::vector<int> factored = spreadOver(motion.frames.size(), kMostPoses),
                         compared = spreadOver(motion.frames.size(), side);
  const PoseMatrix canonical = canonicalPoses(poses, plan)(Eigen::all, factored);
  SparseCodingOptions coding = options.coding;
  coding.components = std::min(coding.components, int(canonical.cols()));
  const SparseCoding style = sparseCodingWithBar(canonical, coding);

  std::vector<int> keys;
  for (std::size_t f = 0; f < motion.frames.size(); ++f)
    if (motion.frames[f].key) keys.push_back(int(f));
  std::vector<int> shown;
  for (const int k : spreadOver(keys.size(), kMostKeys)) shown.push_back(keys[std::size_t(k)]);
  const bool all_pictured = std::none_of(motion.frames.begin(), motion.frames.end(),
                                         [](const MotionFrame& f) { return f.image_file.empty(); });
  const Pictures pictures = lookAtPictures(motion, options.motion, poses, plan, shown,
                                           all_pictured ? compared : std::vector<int>());
  std::vector<Panel> key_panels;
  for (const int f : shown) {
    const auto picture = pictures.keys.find(f);
    key_panels.push_back({picture != pictures.keys.end()
                              ? picture->second
                              : keyPicture(motion.frames[std::size_t(f)], {}, 1, poses.col(f), plan),
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
  const std::vector<Panel> maps = {
      {heatPicture(distances(compared, pictures, poses), side, side), "distance between frames"},
      {heatPicture(style.activations, 2 * side, side), "components over time"}};
  std::vector<Panel> rows;
  if (!key_panels.empty())
    rows.push_back({montage(key_panels, {.columns = 6}),
                    shown.size() == keys.size() ? "key frames"
                                                : std::to_string(shown.size()) + " of " +
                                                      std::to_string(keys.size()) + " key frames"});
  rows.push_back({montage(maps), ""});
  rows.push_back({montage(basis_panels, {.columns = 8}), "mean pose with each component at its most"});
  writeFile(options.output, encodePng(montage(rows, {.columns = 1})));
  const std::string share = canonical.cols() < poses.cols()
                                ? ", of which " + std::to_string(canonical.cols()) + " are factored"
                                : "";
  std::printf("%s: %d frames%s, %d components, off by %.2f %%\n", printable(options.output).c_str(),
              int(poses.cols()), share.c_str(), coding.components, 100 * style.error);
  return ExitCode::kDone;
}

}  // namespace skel
