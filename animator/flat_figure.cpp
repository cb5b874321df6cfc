#include "animator/flat_figure.h"

#include <algorithm>

#include "libskel/core/parallel.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/pipeline/drawn_cut_out.h"
#include "libskel/pipeline/posed_character.h"

namespace skel {
namespace {

constexpr int kFlatMoments = 32;  // of a clip, that decide what the camera shows

// Of the way from the first to the second joint of the limb, how much has pixels of it near by.
double shareOfUpperHalf(const RiggedDrawing& drawing, int limb) {
  constexpr int kSteps = 24;
  constexpr double kNear = 0.15;  // of the way
  const Plane8& map = drawing.layers.limb;
  const TemplateLimb& joints = drawing.body_plan.limbs[std::size_t(limb) - 1];
  const auto place = [&](int k) {
    const Skeleton& skeleton = drawing.recognition.skeleton;
    const std::string& name = drawing.body_plan.joints[std::size_t(joints.joints[std::size_t(k)])].name;
    return skeleton.joints[std::size_t(skeleton.index(name))].image;
  };
  const Eigen::Vector2d from = place(0), way = place(1) - from;
  const int reach = std::max(1, int(kNear * way.norm()));
  int seen = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const Eigen::Vector2d p = from + way * i / kSteps;
    const Eigen::Index x0 = std::max<Eigen::Index>(0, Eigen::Index(p.x()) - reach),
                       y0 = std::max<Eigen::Index>(0, Eigen::Index(p.y()) - reach),
                       x1 = std::min<Eigen::Index>(map.cols(), Eigen::Index(p.x()) + reach + 1),
                       y1 = std::min<Eigen::Index>(map.rows(), Eigen::Index(p.y()) + reach + 1);
    if (x0 < x1 && y0 < y1) seen += (map.block(y0, x0, y1 - y0, x1 - x0) == std::uint8_t(limb)).any();
  }
  return double(seen) / kSteps;
}

Eigen::Vector3d onPlane(const Eigen::Vector2d& p) { return {p.x(), p.y(), 0}; }

}  // namespace

bool looksBetterFlat(const RiggedDrawing& drawing) {
  constexpr double kGuess = 0.33;  // below, joints are one
  return !drawing.body_plan.from_side && drawing.recognition.confidence >= kGuess;
}

std::vector<std::string> flatWarnings(const RiggedDrawing& drawing) {
  constexpr double kLeast = 0.35;
  std::vector<std::string> warnings;
  for (int limb = 1; drawing.layers.any() && limb <= int(drawing.body_plan.limbs.size()); ++limb)
    if (!isLeg(drawing.body_plan, drawing.body_plan.limbs[std::size_t(limb) - 1]) &&
        (drawing.layers.limb == std::uint8_t(limb)).any() && shareOfUpperHalf(drawing, limb) < kLeast)
      warnings.push_back(
          "the " + limbName(drawing.body_plan, limb) +
          " is drawn in part alone and may come off the body: look at the film, or take --look solid");
  return warnings;
}

std::optional<std::string> unseenTurn(const RiggedDrawing& drawing, const Clip& clip) {
  constexpr double kMuch_rad = 0.25, kMuchBent_rad = 0.45;  // clips that come with skel bend less
  const Skeleton& skeleton = drawing.character.skeleton;
  const int head = skeleton.find("head"), body = skeleton.find("body");
  if (head < 0 || body < 0) return std::nullopt;
  const auto at = [&](int joint) { return skeleton.joints[std::size_t(joint)].position; };
  const Eigen::Vector3f trunk = (at(head) - at(body)).normalized().cast<float>();
  for (int i = 0; i < kFlatMoments; ++i) {
    const JointTransforms pose =
        posedAt(drawing.character, clip, double(clip.duration_s()) * i / kFlatMoments);
    const Eigen::Vector3f ahead = pose[std::size_t(body)].linear().transpose() *
                                  pose[std::size_t(head)].linear() * Eigen::Vector3f::UnitZ();
    if (std::abs(std::atan2(double(ahead.x()), double(ahead.z()))) > kMuch_rad)
      return "\"" + clip.name +
             "\" turns the head aside, which the flat look does not show; --look solid does";
    const Eigen::Vector3f bent = pose[std::size_t(body)].linear() * trunk;
    if (std::abs(std::asin(double(bent.z())) - std::asin(double(trunk.z()))) > kMuchBent_rad)
      return "\"" + clip.name + "\" bends the body to the " + (bent.z() > trunk.z() ? "front" : "back") +
             ", which the flat look does not show; --look solid does";
  }
  return std::nullopt;
}

FlatFigure::FlatFigure(const RiggedDrawing& drawing) : drawing_(drawing), cut_out_(cutOutOf(drawing)) {}

Camera FlatFigure::camera(const std::vector<Clip>& clips, double width_over_height) const {
  std::vector<Eigen::MatrixX2d> moments(clips.size() * kFlatMoments);
  parallelFor(moments.size(), 0, [&](std::size_t i) {
    const Clip& clip = clips[i / kFlatMoments];
    const double time_s = double(clip.duration_s()) * double(i % kFlatMoments) / kFlatMoments;
    for (const Eigen::MatrixX2d& sheet : posedSheets(cut_out_, flatPoseAt(drawing_, clip, time_s))) {
      moments[i].conservativeResize(moments[i].rows() + sheet.rows(), 2);
      moments[i].bottomRows(sheet.rows()) = sheet;
    }
  });
  Eigen::MatrixX3f all = drawing_.character.mesh.vertices;
  all.col(2).setZero();
  for (const Eigen::MatrixX2d& moment : moments) {
    all.conservativeResize(all.rows() + moment.rows(), 3);
    all.bottomRows(moment.rows()) << moment.cast<float>(), Eigen::VectorXf::Zero(moment.rows());
  }
  return framingCamera(all, 0, 0, width_over_height);
}

double FlatFigure::tornBy(const Clip& clip) const {
  std::vector<double> torn(kFlatMoments);
  parallelFor(torn.size(), 0, [&](std::size_t i) {
    const double time_s = double(clip.duration_s()) * double(i) / (kFlatMoments - 1);
    torn[i] = tornShare(cut_out_, posedSheets(cut_out_, flatPoseAt(drawing_, clip, time_s)));
  });
  return *std::max_element(torn.begin(), torn.end());
}

CutOutPainter FlatFigure::painterFor(const Camera& camera, int height) const {
  return CutOutPainter(cut_out_, height / camera.view_height_m);
}

void FlatFigure::forgetPictures() {
  for (CutOutSheet& sheet : cut_out_.sheets) sheet.picture = Image(), sheet.lattice.square_of.resize(0, 0);
}

Image FlatFigure::paint(const Clip& clip, double time_s, const Camera& camera, const CutOutPainter& painter,
                        const FilmOptions& options) const {
  const Projection project(camera, options.width, options.height);
  const auto seen = [&](const Eigen::Vector2d& p) {
    return project(onPlane(p)).value_or(Eigen::Vector2d::Constant(-1e4));
  };
  const FlatPose pose = flatPoseAt(drawing_, clip, time_s);
  std::vector<Eigen::MatrixX2d> places = posedSheets(cut_out_, pose);
  for (Eigen::MatrixX2d& sheet : places)
    for (Eigen::Index v = 0; v < sheet.rows(); ++v) sheet.row(v) = seen(sheet.row(v).transpose()).transpose();
  Image image = paintBackground(options.look, options.width, options.height);
  painter.paint(places, image);
  if (options.look.skeleton) {
    Skeleton skeleton = drawing_.character.skeleton;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      skeleton.joints[j].image = seen(pose.place[j]);
      skeleton.joints[j].confidence = 1;
    }
    drawSkeleton(image, skeleton, {.bone_px = boneWidth(options.height)});
  }
  return image;
}

}  // namespace skel
