#pragma once

#include <Eigen/Core>
#include <cmath>

namespace skel {

// From a to b, counter-clockwise where y points up: (-pi, pi].
inline double signedAngle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

}  // namespace skel
