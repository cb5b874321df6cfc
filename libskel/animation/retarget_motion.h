// Somebody else's motion, with a skeleton of its own, for one of our characters. Nothing to configure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "libskel/animation/bvh.h"
#include "libskel/animation/retarget.h"

namespace skel {

struct JointMatch {
  std::vector<std::pair<std::string, std::string>> joints;  // ours, theirs
  std::vector<std::string> ours_left, theirs_left;          // joints without a counterpart
  bool by_shape = false;  // their names said nothing, the shape of their tree did
};

struct RetargetedMotion {
  Clip clip;  // relative to the target's rest pose
  JointMatch match;
  std::vector<std::string> arms_that_stay;  // armsThatStay()
};

struct MotionOptions {
  double into_picture = RetargetOptions().into_picture;
  // Who turns around, as a drawing that has one side cannot, goes on looking where the figure was drawn to
  // look, and moves as before.
  bool keeps_facing = false;
};

// Where their bones point in the world decides, the trunk and the ground included; their rest pose says
// nothing, nor which axis is up, nor how a bone is turned about itself. The figure starts where it stands,
// looking where it was drawn to look; ways are scaled by the length of the legs, and its feet come as near to
// the ground as theirs. Of a motion whose joints are all named like the target's the axes are turned as the
// target's are; if then its rest pose is the target's, in any length, it is the target's own and comes back
// as it is, and if not, trunk and head take its turns as they are, and limbs point where its limbs do. Else
// joints are matched by findJointRoles(). Throws InputError (of `file`) if that finds no arms and legs on
// either side.
RetargetedMotion retargetMotion(const BvhMotion& motion, const std::string& file, const Skeleton& target,
                                const FigureShape& shape, const MotionOptions& options = {});

}  // namespace skel
