#include "libskel/recognition/tree_recognition.h"

#include <cmath>
#include <numbers>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/jointnet/line_strength.h"
#include "libskel/jointnet/tree_recognizer.h"
#include "libskel/recognition/complete_skeleton.h"

namespace skel {

Recognition recognizeByTree(const Image& image, const Silhouette& silhouette,
                            const SkeletonTemplate& body_plan, const JointNet& net) {
  SKEL_CHECK(silhouette.found());
  const WorkingGrid& grid = silhouette.grid;
  const Plane8 lines = lineStrength(gridColours(image, grid.corner_px, grid.scale, grid.width, grid.height),
                                    silhouette.grid_mask);
  const TreeRecognition tree = recognizeByJointNet(silhouette.grid_mask, lines, net);

  Recognition recognition;
  recognition.skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  std::vector<bool> placed(body_plan.joints.size(), false);
  for (size_t j = 0; j < kNetJoints; ++j) {
    const int index = body_plan.find(kNetJointNames[j]);
    if (index < 0)
      throw UsageError("the net knows no template like \"" + body_plan.name +
                       "\"; use --recognizer paper for it");
    Joint& joint = recognition.skeleton.joints[static_cast<size_t>(index)];
    joint.image = grid.imageFromGrid(tree.joints[j].position);
    joint.confidence = tree.joints[j].confidence;
    placed[static_cast<size_t>(index)] = true;
    const bool found = joint.confidence >= kFoundConfidence;
    joint.origin = found ? JointOrigin::kRecognized : JointOrigin::kCompleted;
    if (!found) recognition.missing.push_back(joint.name);
  }
  recognition.confidence = tree.figure_confidence;
  if (recognition.confidence < 0.5) {
    std::string warning = "this hardly looks like one whole " + body_plan.name;
    for (size_t i = 0; i < recognition.missing.size(); ++i)
      warning += (i ? ", " : "; not found: ") + recognition.missing[i];
    recognition.warnings.push_back(warning);
  }
  if (const long degrees = std::lround(tree.turned * 180 / std::numbers::pi); degrees != 0)
    recognition.warnings.push_back("the figure is turned by " + std::to_string(degrees) + " degrees");
  completeSkeleton(recognition.skeleton, placed, body_plan, silhouette);
  return recognition;
}

}  // namespace skel
