// Which joint of anybody's skeleton is what.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// The joints that a biped has, by our names; a joint moves the bone from itself to its child.
inline constexpr std::array<std::string_view, 16> kJointRoles = {
    "pelvis",    "body",           "neck",        "head",       "left_shoulder", "left_elbow",
    "left_hand", "right_shoulder", "right_elbow", "right_hand", "left_hip",      "left_knee",
    "left_foot", "right_hip",      "right_knee",  "right_foot"};

// Its place among them.
std::size_t roleIndex(std::string_view role);

struct JointRoles {
  std::array<int, kJointRoles.size()> joints;  // one a role: an index, or -1
  bool by_shape = false;                       // the names said nothing

  int joint(std::string_view role) const;
};

// By the names of the usual families (CMU, Mixamo with and without its prefix, Rokoko, Blender's and
// Rigify's, VRM, AnimatedDrawings, ours) and, failing that, by the shape of the tree: legs are the two most
// equal branches of the lowest fork, arms those of the next. `tips`: where the bones of leaves end, from the
// joint, one a joint or empty. The only joint of a spine is the body, unless it is called neck. Roles that
// are not found are -1; without both legs or both arms, all are.
JointRoles findJointRoles(const Skeleton& skeleton, const std::vector<Eigen::Vector3d>& tips = {});

// Why there are no roles in a skeleton that has none, a clause: which joints of arms and legs it lacks.
std::string whyNoRoles(const Skeleton& skeleton);

struct RoleJoint {
  std::string role;  // a joint of our quadruped template
  int joint;
};
struct QuadrupedRoles {
  std::vector<RoleJoint> joints;  // parents before children; empty: no animal on four legs
  bool by_shape = false;          // the names of its legs said nothing
  Eigen::Vector3d forwards = Eigen::Vector3d::Zero();  // from the hips to the chest, level, a unit vector
};

// The same for an animal on four legs, y up. Its feet are the ends of the tree near the ground; which is
// which, the words on the way to the trunk say (left, r, front, fore, arm; hind, rear, thigh ...), and
// failing that, where they stand. Of a leg's joints the knee is the one that is farthest ahead: clips bend
// legs there, backwards. Neck, head and tail go by name, or by where the tree ends. The trunk must lie more
// than it stands. Tail, neck, body and head may be missing, legs not.
QuadrupedRoles findQuadrupedRoles(const Skeleton& skeleton);

}  // namespace skel
