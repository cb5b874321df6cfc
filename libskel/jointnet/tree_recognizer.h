// From a silhouette to its joints: the net's heatmaps, then the best tree of joints in them.
#pragma once

#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/net_joints.h"

namespace skel {

// A joint, and what the heatmaps say of the place. A mass is the share of a heatmap that lies within 10 % of
// the figure's long side around a place, [0, 1].
struct TreeJoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // grid px, inside the figure
  double mass = 0;                                     // of its own heatmap
  double rival = 0;         // the same around the likeliest place that is twice as far away
  double counterpart = 0;   // of the heatmap of the same joint of the other side; of the middle 0
  double entropy = 0;       // nats, of its heatmap
  double likelihood = 0;    // log, <= 0: of the place that the search took against the heatmap's likeliest
  double disagreement = 0;  // >= 0: of the figure's heatmap and the mirror image's, -log of their overlap
};

struct TreeRecognition {
  std::vector<TreeJoint> joints;  // as NetJoints
  double figure_logit = 0;        // of the net: log-odds of one whole upright figure of the body plan
  double likeness = 0;            // [0, 1]: below 0.5 it hardly looks like one whole figure of the body plan
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
