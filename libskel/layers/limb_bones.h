// A limb's two bones, and where something lies beside them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>

#include "libskel/core/segment.h"

namespace skel {

// px. Along them 0 is the root, 1 the middle joint, 2 the end.
struct LimbBones {
  std::array<Eigen::Vector2d, 3> joints;

  double length() const { return (joints[1] - joints[0]).norm() + (joints[2] - joints[1]).norm(); }
  Eigen::Vector2d at(double along) const {
    return along < 1 ? Eigen::Vector2d(joints[0] + along * (joints[1] - joints[0]))
                     : Eigen::Vector2d(joints[1] + (along - 1) * (joints[2] - joints[1]));
  }
  struct Near {
    double along = 0, distance = std::numeric_limits<double>::infinity();
  };
  Near nearest(const Eigen::Vector2d& p) const {
    Near near;
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector2d at = nearestOnSegment<Eigen::Vector2d>(p, joints[i], joints[i + 1]);
      const double d = (at - p).norm();
      if (d >= near.distance) continue;
      near.distance = d;
      near.along = double(i) + (at - joints[i]).norm() / std::max(1e-9, (joints[i + 1] - joints[i]).norm());
    }
    return near;
  }
};

}  // namespace skel
