// What the joint net should say, and its loss.
#pragma once

#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/net_joints.h"
#include "trainer/figures/figure.h"

namespace skel {

// What the net should say about one figure.
struct JointTarget {
  struct Joint {
    Eigen::Vector2d cell;  // heatmap cells
    double weight;         // 0: does not count
    bool absent = false;   // the figure has none: the heatmap should say nothing
  };
  std::vector<Joint> joints;
  bool whole;
};

// Where the joints of a generated figure lie in the net's frame.
JointTarget jointTarget(const Figure& figure, const FramePlacement& placement, const NetJoints& joints);

inline constexpr double kTargetVariance = 0.8;  // cells², of the Gaussian around a joint
inline constexpr double kFigureWeight = 0.3;    // of the figure's own loss against a joint's

// Cross-entropy of each heatmap's softmax against a Gaussian (an even spread for an absent joint, so that its
// confidence comes out low), averaged over the joints, plus that of "is one
// whole figure". Adds `scale` times its derivative to `gradient` (the last map, padded). Returns the loss.
template <typename Scalar>
double jointLoss(const std::vector<Scalar>& heatmaps, const JointTarget& target, double scale,
                 std::vector<Scalar>* gradient);

}  // namespace skel
