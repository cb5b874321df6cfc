#include "libskel/animation/sample_pose.h"

#include <algorithm>
#include <cmath>

#include "libskel/animation/clip_limits.h"
#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/skeleton/joint_lookup.h"

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

Eigen::Vector3f between(const std::vector<float>& times, const std::vector<Eigen::Vector3f>& values,
                        float time_s) {
  SKEL_CHECK_EQ(times.size(), values.size());
  const Moment at = momentOf(times, time_s);
  return (1 - at.t) * values[at.key] + at.t * values[at.next];
}

// Of a track that has rotations.
Eigen::Quaternionf rotationAt(const JointTrack& track, RotationInterpolation interpolation, float time_s) {
  SKEL_CHECK_EQ(track.times_s.size(), track.rotations.size());
  if (interpolation == RotationInterpolation::kAngles && !track.angles_rad.empty())
    return rotationOfAngles(between(track.times_s, track.angles_rad, time_s));
  const Moment at = momentOf(track.times_s, time_s);
  // In doubles, as below: rounded to floats, the sines of all C libraries are the same.
  return track.rotations[at.key]
      .cast<double>()
      .slerp(at.t, track.rotations[at.next].cast<double>())
      .cast<float>();
}

}  // namespace

Eigen::Quaternionf rotationOfAngles(const Eigen::Vector3f& angles_rad) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Vector3d angles = angles_rad.cast<double>();
  return Eigen::Quaterniond(AngleAxisd(angles.z(), Vector3d::UnitZ()) *
                            AngleAxisd(angles.y(), Vector3d::UnitY()) *
                            AngleAxisd(angles.x(), Vector3d::UnitX()))
      .cast<float>();
}

ClipSampler::ClipSampler(const Clip& clip, const Skeleton& skeleton)
    : clip_(clip), joint_count_(skeleton.joints.size()) {
  const JointLookup joints(skeleton);
  for (const JointTrack& track : clip.tracks) {
    joints_.push_back(joints.find(track.joint));
    if (joints_.back() < 0)
      throw UsageError("the clip \"" + clip.name + "\" moves \"" + track.joint +
                       "\", which this skeleton lacks; use a clip for the template \"" +
                       skeleton.template_name + "\"");
  }
}

Pose ClipSampler::at(float time_s) const {
  Pose pose;
  pose.rotations.assign(joint_count_, Eigen::Quaternionf::Identity());
  for (std::size_t t = 0; t < clip_.tracks.size(); ++t) {
    const JointTrack& track = clip_.tracks[t];
    const auto joint = std::size_t(joints_[t]);
    SKEL_CHECK(!track.times_s.empty() || !track.translation_times_s.empty() || !track.scale_times_s.empty());
    if (!track.times_s.empty()) pose.rotations[joint] = rotationAt(track, clip_.interpolation, time_s);
    if (!track.translation_times_s.empty()) {
      pose.translations_m.resize(joint_count_, Eigen::Vector3f::Zero());
      pose.translations_m[joint] = between(track.translation_times_s, track.translations_m, time_s);
    }
    if (!track.scale_times_s.empty()) {
      pose.scales.resize(joint_count_, Eigen::Vector3f::Ones());
      pose.scales[joint] = between(track.scale_times_s, track.scales, time_s);
    }
  }
  if (!clip_.root_times_s.empty())
    pose.root_translation = between(clip_.root_times_s, clip_.root_translations, time_s);
  return pose;
}

Pose samplePose(const Clip& clip, const Skeleton& skeleton, float time_s) {
  return ClipSampler(clip, skeleton).at(time_s);
}

Clip withSlerp(const Clip& clip, float rate_hz) {
  Clip result = clip;
  result.interpolation = RotationInterpolation::kSlerp;
  if (clip.interpolation == RotationInterpolation::kSlerp) return result;
  for (JointTrack& track : result.tracks) {
    if (track.angles_rad.empty()) continue;
    checkMoments(clip, double(track.times_s.back()) * double(rate_hz) + double(track.times_s.size()),
                 clip.tracks.size());
    // The keys themselves, and as many even ones between each two as the rate asks for.
    std::vector<float> times;
    for (std::size_t k = 0; k < track.times_s.size(); ++k) {
      if (k > 0) {
        const float from = track.times_s[k - 1], step = track.times_s[k] - from;
        const int parts = std::max(1, int(std::ceil(step * rate_hz - 1e-3f)));
        for (int i = 1; i < parts; ++i) times.push_back(from + step * float(i) / float(parts));
      }
      times.push_back(track.times_s[k]);
    }
    std::vector<Eigen::Quaternionf> rotations;
    for (const float time_s : times) {
      Eigen::Quaternionf rotation = rotationAt(track, clip.interpolation, time_s);
      if (!rotations.empty() && rotation.dot(rotations.back()) < 0) rotation.coeffs() = -rotation.coeffs();
      rotations.push_back(rotation);
    }
    track.times_s = std::move(times);
    track.rotations = std::move(rotations);
    track.angles_rad.clear();
  }
  return result;
}

}  // namespace skel
