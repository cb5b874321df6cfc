// Which joint of anybody's skeleton is what.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// The joints that a biped has, by our names; a joint moves the bone from itself to its child.
inline constexpr std::array<std::string_view, 16> kJointRoles = {
    "pelvis",    "body",           "neck",        "head",       "left_shoulder", "left_elbow",
    "left_hand", "right_shoulder", "right_elbow", "right_hand", "left_hip",      "left_knee",
    "left_foot", "right_hip",      "right_knee",  "right_foot"};

struct JointRoles {
  std::array<int, kJointRoles.size()> joints;  // one a role: an index, or -1
  bool by_shape = false;                       // the names said nothing

  int joint(std::string_view role) const;
};

// By the names of the usual families (CMU, Mixamo with and without its prefix, Rokoko, Blender's and
// Rigify's, VRM, AnimatedDrawings, ours) and, failing that, by the shape of the tree: legs are the two most
// equal branches of the lowest fork, arms those of the next. `tips`: where the bones of leaves end, from the
// joint, one a joint or empty. Roles that are not found are -1; without both legs or both arms, all are.
JointRoles findJointRoles(const Skeleton& skeleton, const std::vector<Eigen::Vector3d>& tips = {});

}  // namespace skel
