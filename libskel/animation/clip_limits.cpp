#include "libskel/animation/clip_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "libskel/core/error.h"

namespace skel {
namespace {

constexpr double kMaxTurns = 2e6;  // of single joints: an hour of a biped at 30 poses a second

}  // namespace

void checkDuration(const Clip& clip) {
  if (static_cast<double>(clip.duration_s()) > kMaxClip_s)
    throw Error(ExitCode::kInput,
                "the clip \"" + clip.name + "\" lasts more than an hour; cut it into parts");
}

void checkTimes(const Clip& clip) {
  checkDuration(clip);
  const auto check = [&](const std::vector<float>& times_s) {
    if (std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal<>()) != times_s.end())
      throw Error(ExitCode::kInput, "the clip \"" + clip.name +
                                        "\" has keys that are nearer than times can tell; take frames away");
  };
  check(clip.root_times_s);
  for (const JointTrack& track : clip.tracks) {
    check(track.times_s);
    check(track.translation_times_s);
    check(track.scale_times_s);
  }
}

void checkMoments(const Clip& clip, double moments, std::size_t joints) {
  if (moments * static_cast<double>(joints) <= kMaxTurns) return;
  throw Error(ExitCode::kInput, "the clip \"" + clip.name +
                                    "\" is too long: " + std::to_string(std::lround(moments)) + " poses of " +
                                    std::to_string(joints) + " joints; cut it into parts");
}

}  // namespace skel
