// Which rest pose a clip's keys are relative to.
#pragma once

#include <string>

#include "libskel/animation/clip.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Of names and parents of all joints, and of where they are in the rest pose, to the millimetre: as hex.
std::string restPoseHash(const Skeleton& skeleton);
// Whether the clip's keys are relative to this skeleton's rest pose (Clip::rest_pose).
bool isRelativeTo(const Clip& clip, const Skeleton& skeleton);

}  // namespace skel
