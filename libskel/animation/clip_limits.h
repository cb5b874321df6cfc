// What bounds the work that a few bytes of a clip can ask for.
#pragma once

#include "libskel/animation/clip.h"

namespace skel {

// Readers refuse what lasts longer.
inline constexpr double kMaxClip_s = 3600;

// Throws Error (refused input) if so many moments of the clip are too many poses of a skeleton of so many
// joints to be computed at once.
void checkMoments(const Clip& clip, double moments, std::size_t joints);

}  // namespace skel
