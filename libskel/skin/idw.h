// Inverse distance weights: what both of its methods share.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/skin/bones.h"

namespace skel {

struct BoneDistance {
  float distance_m = 0;
  int joint = 0, bone = 0;

  bool operator<(const BoneDistance& other) const {
    return distance_m < other.distance_m || (distance_m == other.distance_m && bone < other.bone);
  }
};

// Distances to the segments of all bones, not sorted; `result` keeps its memory from call to call.
void boneDistances(const Eigen::Vector3f& p, const std::vector<Bone>& bones,
                   std::vector<BoneDistance>& result);

// Adds to the joints of the `count` nearest bones w = 1 / ((d / d_min)^power + 0.01), d_min the distance of
// the nearest, no d below 0.001 m. Sorts `bones` as far as needed.
void shareByDistance(std::vector<BoneDistance>& bones, std::size_t count, float power, float* weights);

}  // namespace skel
