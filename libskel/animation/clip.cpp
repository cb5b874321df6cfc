#include "libskel/animation/clip.h"

#include <algorithm>

#include "libskel/core/smooth_step.h"

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

double canonicalShare(const Clip& clip, double time_s) {
  if (clip.lead_s <= 0) return 1;
  return smoothStep(std::min(time_s, clip.duration_s() - time_s) / clip.lead_s);
}

}  // namespace skel
