// The joints that fit the heatmaps and one another best.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/net_joints.h"

namespace skel {

inline constexpr int kHeatmapCells = kHeatmapSize * kHeatmapSize;
using Heatmap = std::array<float, kHeatmapCells>;  // probabilities, sum 1

// The cell of each joint in the tree of highest total score: the heatmaps' log probabilities, less what bones
// cost that leave the figure, that are longer or shorter than others of their kind or out of proportion to
// the bone before. frame px = grid px + offset. `bones`: by joint, or empty.
std::vector<int> searchTree(const Plane8& mask, const Eigen::Vector2d& offset,
                            const std::vector<Heatmap>& heatmaps, const NetJoints& joints,
                            const std::vector<BoneLength>& bones);

}  // namespace skel
