// The pose that a character stands in when nothing moves it.
#pragma once

#include "libskel/export/write_character.h"

namespace skel {

enum class RestPose {
  kDrawn,  // as in the drawing
  kA,      // arms straight, half way down
  kT,      // arms straight, level
};

// The character with mesh and joints in that pose, on the same ground, as a new rest pose; in A and T the
// legs are straight as well. Joint::image stays, as the drawing does. Throws UsageError if the skeleton is
// not a biped.
RiggedCharacter poseToRest(const RiggedCharacter& character, RestPose pose);

}  // namespace skel
