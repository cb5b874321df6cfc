#include "libskel/animation/sample_pose.h"

#include <algorithm>

#include "libskel/core/check.h"
#include "libskel/core/error.h"

namespace skel {

namespace {

// The key at or before `time_s`, and how far it is to the next one, in [0, 1].
struct Moment {
  std::size_t key, next;
  float t;
};

Moment momentOf(const std::vector<float>& times, float time_s) {
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  if (after == times.begin()) return {0, 0, 0};
  const std::size_t key = std::size_t(after - times.begin()) - 1;
  if (after == times.end()) return {key, key, 0};
  return {key, key + 1, (time_s - times[key]) / (times[key + 1] - times[key])};
}

}  // namespace

Pose samplePose(const Clip& clip, const Skeleton& skeleton, float time_s) {
  Pose pose;
  pose.rotations.assign(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  for (const JointTrack& track : clip.tracks) {
    SKEL_CHECK(!track.times_s.empty());
    SKEL_CHECK_EQ(track.times_s.size(), track.rotations.size());
    const int joint = skeleton.find(track.joint);
    if (joint < 0)
      throw UsageError("the clip \"" + clip.name + "\" moves \"" + track.joint +
                       "\", which this skeleton lacks; use a clip for the template \"" +
                       skeleton.template_name + "\"");
    const Moment at = momentOf(track.times_s, time_s);
    pose.rotations[joint] = track.rotations[at.key].slerp(at.t, track.rotations[at.next]);
  }
  if (!clip.root_times_s.empty()) {
    SKEL_CHECK_EQ(clip.root_times_s.size(), clip.root_translations.size());
    const Moment at = momentOf(clip.root_times_s, time_s);
    pose.root_translation =
        (1 - at.t) * clip.root_translations[at.key] + at.t * clip.root_translations[at.next];
  }
  return pose;
}

}  // namespace skel
