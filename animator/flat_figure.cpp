#include "animator/flat_figure.h"

#include <algorithm>

#include "libskel/core/parallel.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/pipeline/posed_character.h"

namespace skel {
namespace {

constexpr int kFlatMoments = 32;  // of a clip, that decide what the camera shows

Eigen::Vector3d onPlane(const Eigen::Vector2d& p) { return {p.x(), p.y(), 0}; }

}  // namespace

bool looksBetterFlat(const RiggedDrawing& drawing) {
  constexpr double kGuess = 0.33;  // below, joints are one
  return !drawing.body_plan.from_side && drawing.recognition.confidence >= kGuess;
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
  std::vector<Calm> calms;
  for (const Clip& clip : clips) calms.push_back(calmFor(clip));
  std::vector<Eigen::MatrixX2d> moments(clips.size() * kFlatMoments);
  parallelFor(moments.size(), 0, [&](std::size_t i) {
    const Clip& clip = clips[i / kFlatMoments];
    const double time_s = double(clip.duration_s()) * double(i % kFlatMoments) / kFlatMoments;
    for (const Eigen::MatrixX2d& sheet :
         posedSheets(cut_out_, flatPoseAt(drawing_, clip, time_s, calms[i / kFlatMoments]))) {
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

Calm FlatFigure::calmFor(const Clip& clip) const {
  const auto [known, is_new] = calm_.try_emplace(clip.name);
  if (is_new) known->second = skel::calmFor(drawing_, cut_out_, clip);
  return known->second;
}

CutOutPainter FlatFigure::painterFor(const Camera& camera, int height) const {
  return CutOutPainter(cut_out_, height / camera.view_height_m);
}

void FlatFigure::forgetPictures() {
  for (CutOutSheet& sheet : cut_out_.sheets) sheet.picture = Image(), sheet.lattice.square_of.resize(0, 0);
}

Image FlatFigure::paint(const Clip& clip, const Calm& calm, double time_s, const Camera& camera,
                        const CutOutPainter& painter, const FilmOptions& options) const {
  const Projection project(camera, options.width, options.height);
  const auto seen = [&](const Eigen::Vector2d& p) {
    return project(onPlane(p)).value_or(Eigen::Vector2d::Constant(-1e4));
  };
  const FlatPose pose = flatPoseAt(drawing_, clip, time_s, calm);
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
