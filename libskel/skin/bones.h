// The segments that joints move.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct Bone {
  int joint;                 // that moves it
  int limb;                  // -1: of the trunk; else the bones of an arm, a leg, a head have one number
  Eigen::Vector3f from, to;  // model frame, m; may coincide
};

// The limb of each joint: a chain of joints that ends in a leaf, from below the joint where it branches off.
// -1: none.
std::vector<int> jointLimbs(const Skeleton& skeleton);

// In the order of the joints: to their tails, or, where no joint has one, to their children (see
// skin_weights.h).
std::vector<Bone> skeletonBones(const Skeleton& skeleton);

// Whether the bones lie about a plane that faces the viewer, as those of a drawing do.
bool nearlyFlat(const std::vector<Bone>& bones);

}  // namespace skel
