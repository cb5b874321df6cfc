#include "libskel/animation/clip.h"

#include <algorithm>

namespace skel {

float Clip::duration_s() const {
  float duration = least_duration_s;
  const auto lastsUntil = [&](const std::vector<float>& times) {
    if (!times.empty()) duration = std::max(duration, times.back());
  };
  lastsUntil(root_times_s);
  for (const JointTrack& track : tracks) {
    lastsUntil(track.times_s);
    lastsUntil(track.translation_times_s);
    lastsUntil(track.scale_times_s);
  }
  return duration;
}

}  // namespace skel
