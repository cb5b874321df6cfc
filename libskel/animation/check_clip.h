// Clips that a program has made itself.
#pragma once

#include <string>

#include "libskel/animation/clip.h"

namespace skel {

// Throws UsageError that begins with `before` and says which clip, track and key is wrong: keys without
// times, times that go back, a number that is not finite, a rotation of length 0, a track of no keys, two
// tracks of one joint. Throws Error (refused input) if it lasts longer than kMaxClip_s. Whether a skeleton
// has the joints is not looked at.
void checkClip(const Clip& clip, const std::string& before = "");

}  // namespace skel
