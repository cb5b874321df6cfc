// The motions that come with skel.
#pragma once

#include <string_view>

#include "libskel/animation/clip.h"
#include "libskel/skeleton/template.h"

namespace skel {

// All of them, for the canonical pose.
const std::vector<Clip>& builtinClips();

// Those that move only joints which the body plan has.
std::vector<Clip> builtinClipsFor(const SkeletonTemplate& body_plan);

// Throws UsageError that lists the names there are.
const Clip& builtinClip(std::string_view name);

}  // namespace skel
