#include "libskel/animation/clip.h"

#include <algorithm>

namespace skel {

float Clip::duration_s() const {
  float duration = root_times_s.empty() ? 0 : root_times_s.back();
  for (const JointTrack& track : tracks)
    if (!track.times_s.empty()) duration = std::max(duration, track.times_s.back());
  return duration;
}

}  // namespace skel
