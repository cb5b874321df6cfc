#include "animator/flat_figure.h"

#include "libskel/core/parallel.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/pipeline/drawn_cut_out.h"

namespace skel {
namespace {

constexpr int kFlatMoments = 32;  // of a clip, that decide what the camera shows

Eigen::Vector3d onPlane(const Eigen::Vector2d& p) { return {p.x(), p.y(), 0}; }

}  // namespace

bool looksBetterFlat(const RiggedDrawing& drawing) {
  constexpr double kGuess = 0.33;  // below, joints are one
  return !drawing.body_plan.from_side && drawing.recognition.confidence >= kGuess;
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
