#include "animator/pose_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "libskel/animation/clip_keys.h"
#include "libskel/core/error.h"
#include "libskel/core/json.h"

namespace skel {
namespace {

constexpr const char* kPoseFormat = "skel-pose";

nlohmann::ordered_json numbers(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string formatPose(const Pose& pose, const Skeleton& skeleton) {
  nlohmann::ordered_json document;
  document["format"] = kPoseFormat;
  document["version"] = 1;
  if (!pose.root_translation.isZero(0)) document["root_translation"] = numbers(pose.root_translation);
  auto& joints = document["joints"] = nlohmann::ordered_json::object();
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    nlohmann::ordered_json joint = nlohmann::ordered_json::object();
    const Eigen::Quaternionf& q = pose.rotations[j];
    if (!q.coeffs().isApprox(Eigen::Quaternionf::Identity().coeffs(), 0))
      joint["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    if (!pose.translations_m.empty() && !pose.translations_m[j].isZero(0))
      joint["translation_m"] = numbers(pose.translations_m[j]);
    if (!pose.scales.empty() && !pose.scales[j].isApprox(Eigen::Vector3f::Ones(), 0))
      joint["scale"] = numbers(pose.scales[j]);
    if (!joint.empty()) joints[skeleton.joints[j].name] = std::move(joint);
  }
  return document.dump(1) + "\n";
}

Pose parsePose(std::string_view text, const std::string& file, const Skeleton& skeleton) {
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.allowOnly({"format", "version", "root_translation", "joints"});
  root.checkFormat(kPoseFormat, 1);
  Pose pose;
  pose.rotations.assign(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  if (const auto moved = root.find("root_translation"))
    pose.root_translation = vectorAt(*moved, moved->asNumbers(3).data(), kMaxPlace);
  const JsonValue joints = root.at("joints");
  for (const std::string& name : joints.keys()) {
    const JsonValue joint = joints.at(name);
    const int index = skeleton.find(name);
    if (index < 0) joint.fail("is a joint that this character lacks; its pose belongs to another skeleton");
    const auto j = std::size_t(index);
    joint.allowOnly({"rotation", "translation_m", "scale"});
    if (const auto rotation = joint.find("rotation")) {
      const std::vector<double> q = rotation->asNumbers(4);
      const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
      if (std::abs(turn.norm() - 1) > 1e-3) rotation->fail("is no rotation: its length is not 1");
      pose.rotations[j] = turn.normalized().cast<float>();
    }
    if (const auto translation = joint.find("translation_m")) {
      pose.translations_m.resize(skeleton.joints.size(), Eigen::Vector3f::Zero());
      pose.translations_m[j] = vectorAt(*translation, translation->asNumbers(3).data(), kMaxPlace);
    }
    if (const auto scale = joint.find("scale")) {
      pose.scales.resize(skeleton.joints.size(), Eigen::Vector3f::Ones());
      pose.scales[j] = vectorAt(*scale, scale->asNumbers(3).data(), kMaxPlace);
    }
  }
  return pose;
}

bool isPoseFile(std::string_view text) {
  try {
    const JsonDocument document = JsonDocument::parse(text, "");
    const JsonValue root = document.root();
    if (!root.isObject()) return false;
    const auto format = root.find("format");
    return format && format->asString() == kPoseFormat;
  } catch (const InputError&) {
    return false;
  }
}

Clip clipOfPose(const Pose& pose, const Skeleton& skeleton, const std::string& name) {
  Clip clip;
  clip.name = name;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    JointTrack& track = clip.tracks.emplace_back();
    track.joint = skeleton.joints[j].name;
    track.times_s = {0};
    track.rotations = {pose.rotations[j]};
    if (!pose.translations_m.empty()) {
      track.translation_times_s = {0};
      track.translations_m = {pose.translations_m[j]};
    }
    if (!pose.scales.empty()) {
      track.scale_times_s = {0};
      track.scales = {pose.scales[j]};
    }
  }
  clip.root_times_s = {0};
  clip.root_translations = {pose.root_translation};
  return clip;
}

}  // namespace skel
