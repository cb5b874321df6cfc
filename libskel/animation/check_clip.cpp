#include "libskel/animation/check_clip.h"

#include <cmath>
#include <set>
#include <string_view>

#include "libskel/animation/clip_limits.h"
#include "libskel/core/error.h"
#include "libskel/core/json_names.h"

namespace skel {
namespace {

// Says where it is only once something is wrong: clips are looked at before every rig.
struct PlaceInClip {
  const Clip& clip;
  const std::string& before;
  int track = -1;  // none: the root, or the clip as a whole

  [[noreturn]] void refuse(const std::string& why) const {
    throw UsageError(before + "the clip \"" + jsonFromFileName(clip.name) +
                     "\": " + (track < 0 ? "" : "tracks[" + std::to_string(track) + "].") + why);
  }
};

std::string keyOf(const char* member, std::size_t key) { return member + ("[" + std::to_string(key) + "]"); }

void checkClipTimes(const PlaceInClip& place, const char* member, const std::vector<float>& times_s) {
  for (std::size_t k = 0; k < times_s.size(); ++k)
    if (!std::isfinite(times_s[k]) || times_s[k] < (k == 0 ? 0 : times_s[k - 1]))
      place.refuse(keyOf(member, k) + " must be 0 or more, and no earlier than the time before it");
}

void checkKeyCount(const PlaceInClip& place, const char* times, std::size_t time_count, const char* member,
                   std::size_t count) {
  if (count != time_count)
    place.refuse(std::string(member) + " has " + std::to_string(count) + " keys, " + times + " has " +
                 std::to_string(time_count));
}

void checkPlaces(const PlaceInClip& place, const char* member, const std::vector<Eigen::Vector3f>& values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k].cwiseAbs().maxCoeff() <= float(kMaxPlace)) || !values[k].allFinite())
      place.refuse(keyOf(member, k) + " must hold finite numbers of at most 1e6");
}

void checkTrack(const PlaceInClip& place, const JointTrack& track) {
  // Others are made to be of length 1 where they are used.
  constexpr float kLeast = 1e-6f, kMost = 1e6f;
  if (track.times_s.empty() && track.translation_times_s.empty() && track.scale_times_s.empty())
    place.refuse("times_s and those of the other keys are empty: a track needs one key");
  checkClipTimes(place, "times_s", track.times_s);
  checkClipTimes(place, "translation_times_s", track.translation_times_s);
  checkClipTimes(place, "scale_times_s", track.scale_times_s);
  checkKeyCount(place, "times_s", track.times_s.size(), "rotations", track.rotations.size());
  if (!track.angles_rad.empty())
    checkKeyCount(place, "times_s", track.times_s.size(), "angles_rad", track.angles_rad.size());
  checkKeyCount(place, "translation_times_s", track.translation_times_s.size(), "translations_m",
                track.translations_m.size());
  checkKeyCount(place, "scale_times_s", track.scale_times_s.size(), "scales", track.scales.size());
  for (std::size_t k = 0; k < track.rotations.size(); ++k)
    if (const float length = track.rotations[k].squaredNorm(); !(length >= kLeast && length <= kMost))
      place.refuse(keyOf("rotations", k) + " is no rotation: its four numbers must have length 1");
  checkPlaces(place, "angles_rad", track.angles_rad);
  checkPlaces(place, "translations_m", track.translations_m);
  checkPlaces(place, "scales", track.scales);
  if (!track.bone.allFinite()) place.refuse("bone holds a number that is not finite");
  if (!std::isfinite(track.slack_rad)) place.refuse("slack_rad must be finite");
}

}  // namespace

void checkClip(const Clip& clip, const std::string& before) {
  const PlaceInClip whole{clip, before};
  if (jsonFromFileName(clip.name) != clip.name) whole.refuse("name is no UTF-8");
  std::set<std::string_view> moved;
  for (std::size_t t = 0; t < clip.tracks.size(); ++t) {
    const PlaceInClip place{clip, before, int(t)};
    const JointTrack& track = clip.tracks[t];
    if (!moved.insert(track.joint).second)
      place.refuse("joint is \"" + track.joint + "\", which has a track already");
    checkTrack(place, track);
  }
  checkClipTimes(whole, "root_times_s", clip.root_times_s);
  checkKeyCount(whole, "root_times_s", clip.root_times_s.size(), "root_translations",
                clip.root_translations.size());
  checkPlaces(whole, "root_translations", clip.root_translations);
  for (const FootContact& contact : clip.contacts)
    if (!std::isfinite(contact.from_s) || !std::isfinite(contact.to_s))
      whole.refuse("contacts must have finite times");
  if (!std::isfinite(clip.lead_s)) whole.refuse("lead_s must be finite");
  if (!std::isfinite(clip.least_duration_s)) whole.refuse("least_duration_s must be finite");
  checkDuration(clip);
}

}  // namespace skel
