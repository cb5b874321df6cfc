// The motions that come with skel, for the biped.
#pragma once

#include <string_view>

#include "libskel/animation/clip.h"

namespace skel {

// All of them, for the canonical pose.
const std::vector<Clip>& builtinClips();

// Throws UsageError that lists the names there are.
const Clip& builtinClip(std::string_view name);

}  // namespace skel
