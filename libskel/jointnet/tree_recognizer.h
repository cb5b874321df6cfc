// From a silhouette to its joints: the net's heatmaps, then the best tree of joints in them.
#pragma once

#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/net_joints.h"

namespace skel {

struct TreeJoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // grid px, inside the figure
  double confidence = 0;  // [0, 1]: chance that it lies within 10 % of the figure's long side
};

struct TreeRecognition {
  std::vector<TreeJoint> joints;  // as NetJoints
  double figure_confidence = 0;   // [0, 1]: below 0.5 it is hardly one whole figure of the body plan
  double turned = 0;   // radians: how far (from +x towards +y) the figure is turned against upright
  double entropy = 0;  // nats, mean over the heatmaps
};

struct TreeRecognizerOptions {
  InstructionSet instructions = bestInstructionSet();
  bool mirror = true;            // average with the mirrored figure
  bool try_orientations = true;  // if the net doubts that the figure stands upright
};

// `mask` is the working grid (not 0 on the figure, at least one such px, long side at most 128 px), `look`
// what its inside looks like, or nothing. `joints`: netJoints(net.joints, ...).
TreeRecognition recognizeByJointNet(const Plane8& mask, const FigureLook& look, const JointNet& net,
                                    const NetJoints& joints, const TreeRecognizerOptions& options = {});

}  // namespace skel
