#include "libskel/recognition/tree_recognition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/core/check.h"
#include "libskel/jointnet/figure_look.h"
#include "libskel/recognition/complete_skeleton.h"
#include "libskel/recognition/confidence_model.h"
#include "libskel/recognition/joint_note.h"

namespace skel {
namespace {

// Figure pixels along the side of the picture that has most of them, as a share of the figure's long side. A
// tight crop touches the border with a hand or a sole; a figure that goes on beyond it lies there with its
// width.
double shareCutOff(const Plane8& mask, const WorkingGrid& grid) {
  const auto count = [](const auto& line) { return static_cast<double>((line > 0).count()); };
  const double most = std::max({count(mask.row(0)), count(mask.row(mask.rows() - 1)), count(mask.col(0)),
                                count(mask.col(mask.cols() - 1))});
  return most * grid.scale / kWorkingGridSize;
}

constexpr double kCutOff = 0.25;   // share that says that the figure goes on beyond the border
constexpr double kNotWhole = 0.4;  // the most that such a figure can have

}  // namespace

Recognition recognizeByTree(const Image& image, const Silhouette& silhouette,
                            const SkeletonTemplate& body_plan, const JointNet& net,
                            const TreeRecognizerOptions& options) {
  SKEL_CHECK(silhouette.found());
  const NetJoints joints = netJoints(net.joints, body_plan);
  const WorkingGrid& grid = silhouette.grid;
  const FigureLook look = figureLook(gridColours(image, grid.corner_px, grid.scale, grid.width, grid.height),
                                     silhouette.grid_mask);
  const TreeRecognition tree = recognizeByJointNet(silhouette.grid_mask, look, net, joints, options);
  const Confidences sure =
      confidencesOf(evidenceOf(tree, silhouette.grid_mask, net, joints, body_plan), builtInConfidenceModel());

  Recognition recognition;
  recognition.skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  std::vector<bool> placed(body_plan.joints.size(), false);
  for (size_t j = 0; j < joints.names.size(); ++j) {
    const int index = recognition.skeleton.index(joints.names[j]);
    Joint& joint = recognition.skeleton.joints[static_cast<size_t>(index)];
    joint.image = grid.imageFromGrid(tree.joints[j].position);
    joint.confidence = sure.joints[j];
    placed[static_cast<size_t>(index)] = true;
    const bool found = joint.confidence >= kFoundConfidence;
    joint.origin = found ? JointOrigin::kRecognized : JointOrigin::kCompleted;
    if (!found) recognition.missing.push_back(joint.name);
  }
  recognition.confidence = sure.figure;
  recognition.likeness = tree.likeness;
  if (!silhouette.clear_around && shareCutOff(silhouette.mask, grid) > kCutOff)
    recognition.likeness = std::min(recognition.likeness, kNotWhole);
  // Where there is no figure nobody can be sure of its joints.
  if (recognition.likeness < kHardlyOne) recognition.confidence = std::min(recognition.confidence, kNotWhole);
  if (const std::string note = jointNote(recognition, body_plan.name); !note.empty())
    recognition.warnings.push_back(note);
  recognition.turned_deg = static_cast<int>(std::lround(tree.turned * 180 / std::numbers::pi));
  if (recognition.turned_deg != 0)
    recognition.warnings.push_back("the figure is turned by " + std::to_string(recognition.turned_deg) +
                                   " degrees");
  completeSkeleton(recognition.skeleton, placed, body_plan, silhouette);
  return recognition;
}

}  // namespace skel
