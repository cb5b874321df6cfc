// What bounds the work that a few bytes of a clip can ask for.
#pragma once

#include "libskel/animation/clip.h"

namespace skel {

// Readers refuse what lasts longer.
inline constexpr double kMaxClip_s = 3600;

// Of translations, in m or in heights of the figure, and of scales, each way: readers refuse more.
inline constexpr double kMaxPlace = 1e6;

// Of all clips of a model together, whose joints and clips may share the same numbers: readers refuse more.
inline constexpr std::size_t kMaxKeys = 10'000'000;

// Of a model: each is held against the others, by its name or as a whole.
inline constexpr std::size_t kMostClips = 25'000;

// Throws Error (refused input) if the clip lasts longer than kMaxClip_s.
void checkDuration(const Clip& clip);

// Throws Error (refused input) if readers would refuse what is written of the clip: it lasts longer, or two
// keys of a track are at the same time, as floats.
void checkTimes(const Clip& clip);

// Throws Error (refused input) if so many moments of the clip are too many poses of a skeleton of so many
// joints to be computed at once.
void checkMoments(const Clip& clip, double moments, std::size_t joints);

}  // namespace skel
