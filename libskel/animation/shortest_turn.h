#pragma once

#include <Eigen/Geometry>

namespace skel {

// The least rotation that takes the direction of `from` to that of `to`; of opposite ones any half turn.
// Eigen's setFromTwoVectors() for that case brings a singular value decomposition into every file.
Eigen::Quaterniond shortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace skel
