#include "libskel/animation/keyframe_clip.h"

#include <cmath>
#include <optional>

#include "libskel/animation/clip_keys.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/unused_keys.h"

namespace skel {
namespace {

constexpr double kMaxAngle_rad = 1000;

Eigen::Vector3f yUp(const Eigen::Vector3f& v) { return {v.x(), v.z(), -v.y()}; }

// Turned axes: the rotation about each becomes one about where it points now.
void turnUp(Clip& clip) {
  // Angles about the old axes are not angles about the new ones.
  if (clip.interpolation == RotationInterpolation::kAngles) clip = withSlerp(clip, 60);
  for (JointTrack& track : clip.tracks) {
    track.angles_rad.clear();
    for (Eigen::Quaternionf& rotation : track.rotations) rotation.vec() = yUp(rotation.vec());
    for (Eigen::Vector3f& place : track.translations_m) place = yUp(place);
    for (Eigen::Vector3f& scale : track.scales) scale = {scale.x(), scale.z(), scale.y()};
  }
}

JointTrack trackAt(const std::string& joint, const JsonValue& list, UnusedKeys& unused) {
  JointTrack track;
  track.joint = joint;
  std::vector<float> times;
  for (const JsonValue& key : list.items()) {
    unused.take(key, {"time", "rotation", "translation", "scale"});
    const JsonValue time = key.at("time");
    takeTime(time, time.asNumber(), times);
    const auto vector = [&](const char* name, double limit,
                            std::vector<float>& own_times) -> std::optional<Eigen::Vector3f> {
      const auto value = key.find(name);
      if (!value || value->isNull()) return std::nullopt;
      const std::vector<double> numbers = value->asNumbers(3);
      own_times.push_back(times.back());
      return vectorAt(*value, numbers.data(), limit);
    };
    if (const auto angles = vector("rotation", kMaxAngle_rad, track.times_s)) {
      track.angles_rad.push_back(*angles);
      track.rotations.push_back(rotationOfAngles(*angles));
    }
    if (const auto place = vector("translation", kMaxPlace, track.translation_times_s))
      track.translations_m.push_back(*place);
    if (const auto scale = vector("scale", kMaxPlace, track.scale_times_s)) track.scales.push_back(*scale);
  }
  return track;
}

}  // namespace

Clip parseKeyframeClip(std::string_view text, const std::string& file, const Skeleton& skeleton,
                       const KeyframeClipOptions& options, std::string* note) {
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  UnusedKeys unused;
  unused.take(root, {"name", "duration", "keyframes"});
  Clip clip;
  clip.name = root.at("name").asString();
  clip.interpolation = options.interpolation;
  if (const auto duration = root.find("duration"))
    clip.least_duration_s = float(duration->asNumber(0, kMaxClip_s));
  const JsonValue keyframes = root.at("keyframes");
  for (const std::string& joint : keyframes.keys()) {
    const JsonValue list = keyframes.at(joint);
    if (skeleton.find(joint) < 0) list.fail("\"" + joint + "\" is no joint of the skeleton");
    JointTrack track = trackAt(joint, list, unused);
    if (track.times_s.empty() && track.translation_times_s.empty() && track.scale_times_s.empty())
      continue;  // a joint without keys holds its rest pose
    clip.tracks.push_back(std::move(track));
  }
  if (options.z_up) turnUp(clip);
  if (note) *note = unused.note(file);
  return clip;
}

bool isKeyframeClip(std::string_view text) {
  try {
    const JsonDocument document = JsonDocument::parse(text, "");
    const JsonValue root = document.root();
    return root.isObject() && root.find("keyframes");
  } catch (const InputError&) {
    return false;
  }
}

Clip readKeyframeClip(const std::string& path, const Skeleton& skeleton, const KeyframeClipOptions& options) {
  return parseKeyframeClip(readFile(path), path, skeleton, options);
}

}  // namespace skel
