// What the right does, done by the left.
#pragma once

#include "libskel/animation/clip.h"

namespace skel {

// The clip seen in a mirror: "left_" joints do what "right_" ones did, turned to the other side. For clips in
// the model frame, of joints that are unturned in the rest pose.
Clip mirrored(const Clip& clip);

}  // namespace skel
