// The segments that joints move.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct Bone {
  int joint;                 // that moves it
  Eigen::Vector3f from, to;  // model frame, m; may coincide
};

// In the order of the joints.
std::vector<Bone> skeletonBones(const Skeleton& skeleton);

template <int kDimension>
float distanceToSegment(const Eigen::Matrix<float, kDimension, 1>& p,
                        const Eigen::Matrix<float, kDimension, 1>& a,
                        const Eigen::Matrix<float, kDimension, 1>& b) {
  const Eigen::Matrix<float, kDimension, 1> along = b - a;
  const float length2 = along.squaredNorm();
  const float t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0f, 1.0f) : 0.0f;
  return (a + t * along - p).norm();
}

}  // namespace skel
