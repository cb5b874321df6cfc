#include "libskel/animation/clip_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "libskel/animation/clip_keys.h"
#include "libskel/animation/clip_limits.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/check.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/number_chars.h"

namespace skel {
namespace {

constexpr const char* kFormat = "skel-clip";
constexpr int kVersion = 1;
constexpr double kDegree = std::numbers::pi / 180;

constexpr std::array<const char*, 4> kEaseNames = {"none", "rest", "flow", "loop"};  // by KeyEase

KeyEase easeAt(const std::optional<JsonValue>& value) {
  if (!value) return KeyEase::kNone;
  const std::string name = value->asString();
  for (std::size_t i = 0; i < kEaseNames.size(); ++i)
    if (name == kEaseNames[i]) return KeyEase(i);
  value->fail("is \"" + name + "\", must be none, rest, flow or loop");
}

// Of three numbers, or of the four of a rotation, which is the same with all signs turned.
template <int kCount>
using Value = Eigen::Matrix<double, kCount, 1>;
template <int kCount>
struct Key {
  double time_s;
  Value<kCount> value;
};
template <int kCount>
using Keys = std::vector<Key<kCount>>;

// A pair of eased keys becomes as many as the time between them asks for.
constexpr std::size_t kMaxSamples = 1'000'000, kMaxContacts = 1000;

// The key's slope: the straight line between its neighbours, or level at the ends.
template <int kCount>
Value<kCount> slope(const Keys<kCount>& keys, std::size_t i, KeyEase ease) {
  const std::size_t last = keys.size() - 1;
  if (i > 0 && i < last)
    return (keys[i + 1].value - keys[i - 1].value) / (keys[i + 1].time_s - keys[i - 1].time_s);
  if (ease != KeyEase::kLoop) return Value<kCount>::Zero();
  const double across = keys[1].time_s - keys[0].time_s + keys[last].time_s - keys[last - 1].time_s;
  Value<kCount> out = keys[1].value - keys[0].value, in = keys[last].value - keys[last - 1].value;
  if (kCount == 4 && keys[last].value.dot(keys[0].value) < 0) (i == 0 ? in : out) *= -1;
  return (out + in) / across;
}

template <int kCount>
Value<kCount> eased(const Keys<kCount>& keys, double time_s, KeyEase ease) {
  if (keys.size() == 1) return keys[0].value;
  const auto later = std::lower_bound(keys.begin() + 1, keys.end() - 1, time_s,
                                      [](const Key<kCount>& key, double time) { return key.time_s < time; });
  const auto next = std::size_t(later - keys.begin());
  const Key<kCount>&a = keys[next - 1], &b = keys[next];
  const double length = b.time_s - a.time_s, t = std::clamp((time_s - a.time_s) / length, 0.0, 1.0);
  if (ease == KeyEase::kRest)
    return a.value + (b.value - a.value) * (0.5 - 0.5 * std::cos(t * std::numbers::pi));
  // Cubic Hermite.
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a.value + (t3 - 2 * t2 + t) * length * slope(keys, next - 1, ease) +
         (3 * t2 - 2 * t3) * b.value + (t3 - t2) * length * slope(keys, next, ease);
}

// How the keys of a file ease, and how many there are by now that take the place of eased ones.
struct Easing {
  KeyEase ease = KeyEase::kNone;
  std::size_t samples = 0;
};

// Even keys in place of eased ones.
template <int kCount>
Keys<kCount> sampled(const Keys<kCount>& keys, const JsonValue& list, Easing& easing) {
  const KeyEase ease = easing.ease;
  if (ease == KeyEase::kNone || keys.size() < 2) return keys;
  Keys<kCount> result;
  const int last = int(std::lround(keys.back().time_s * kEasedRate_hz));
  easing.samples += std::size_t(last) + 1;
  if (easing.samples > kMaxSamples)
    list.fail("makes more than " + std::to_string(kMaxSamples) +
              " keys of eased ones; cut the clip into parts");
  for (int i = 0; i <= last; ++i) {
    const double time_s = i / kEasedRate_hz;
    result.push_back({time_s, eased(keys, time_s, ease)});
  }
  return result;
}

// [[time_s, x, y, z], …]
Keys<3> keysAt(const JsonValue& list, double limit) {
  Keys<3> keys;
  std::vector<float> times;
  for (const JsonValue& item : list.items()) {
    const std::vector<double> numbers = item.asNumbers(4);
    takeTime(item, numbers[0], times);
    vectorAt(item, &numbers[1], limit);
    keys.push_back({numbers[0], {numbers[1], numbers[2], numbers[3]}});
  }
  if (keys.empty()) list.fail("is empty");
  return keys;
}

void vectorKeys(const JsonValue& list, double limit, Easing& easing, std::vector<float>& times,
                std::vector<Eigen::Vector3f>& values) {
  for (const Key<3>& key : sampled(keysAt(list, limit), list, easing)) {
    times.push_back(float(key.time_s));
    values.push_back(key.value.cast<float>());
  }
}

// [[time_s, x, y, z, w], …]
void quaternionKeys(const JsonValue& list, Easing& easing, JointTrack& track) {
  for (const JsonValue& item : list.items()) {
    const std::vector<double> n = item.asNumbers(5);
    takeTime(item, n[0], track.times_s);
    Eigen::Quaterniond rotation(n[4], n[1], n[2], n[3]);
    const double norm = rotation.norm();
    if (!(std::abs(norm - 1) <= 1e-2)) item.fail("is no rotation: its last four numbers must have length 1");
    if (std::abs(norm - 1) > 1e-6) rotation.normalize();
    track.rotations.push_back(rotation.cast<float>());
  }
  if (track.times_s.empty()) list.fail("is empty");
  if (easing.ease == KeyEase::kNone) return;
  Keys<4> keys;
  for (std::size_t k = 0; k < track.times_s.size(); ++k) {
    Eigen::Vector4d value = track.rotations[k].coeffs().cast<double>();
    if (k > 0 && value.dot(keys.back().value) < 0) value = -value;  // the shorter way
    keys.push_back({track.times_s[k], value});
  }
  track.times_s.clear();
  track.rotations.clear();
  for (const Key<4>& key : sampled(keys, list, easing)) {
    track.times_s.push_back(float(key.time_s));
    track.rotations.push_back(Eigen::Quaterniond(key.value).normalized().cast<float>());
  }
}

void angleKeys(const JsonValue& list, Easing& easing, JointTrack& track) {
  for (const Key<3>& key : sampled(keysAt(list, kMaxAngle_deg), list, easing)) {
    const Eigen::Vector3f angles = (key.value * kDegree).cast<float>();
    track.times_s.push_back(float(key.time_s));
    track.rotations.push_back(rotationOfAngles(angles));
    if (easing.ease == KeyEase::kNone) track.angles_rad.push_back(angles);
  }
}

JointTrack trackAt(const JsonValue& value, Easing& easing) {
  value.allowOnly({"joint", "bone", "slack_deg", "rotations", "angles_deg", "translations_m", "scales"});
  JointTrack track;
  track.joint = value.at("joint").asString();
  if (track.joint.empty()) value.at("joint").fail("must not be empty");
  if (const auto bone = value.find("bone")) {
    const std::vector<double> n = bone->asNumbers(3);
    const Eigen::Vector3f direction = vectorAt(*bone, n.data(), kMaxPlace);
    if (!(direction.norm() > 1e-3f)) bone->fail("must be a direction");
    track.bone = std::abs(direction.norm() - 1) > 1e-6f ? direction.normalized() : direction;
  }
  if (const auto slack = value.find("slack_deg")) {
    if (track.bone.isZero()) slack->fail("needs a bone");
    track.slack_rad = float(slack->asNumber(0, 180) * kDegree);
  }
  const auto rotations = value.find("rotations"), angles = value.find("angles_deg");
  if (rotations && angles) angles->fail("stands beside \"rotations\"; give one of them");
  if (rotations) quaternionKeys(*rotations, easing, track);
  if (angles) angleKeys(*angles, easing, track);
  if (const auto places = value.find("translations_m"))
    vectorKeys(*places, kMaxPlace, easing, track.translation_times_s, track.translations_m);
  if (const auto scales = value.find("scales"))
    vectorKeys(*scales, kMaxPlace, easing, track.scale_times_s, track.scales);
  if (track.times_s.empty() && track.translation_times_s.empty() && track.scale_times_s.empty())
    value.fail("has no keys; give \"rotations\", \"angles_deg\", \"translations_m\" or \"scales\"");
  return track;
}

FootContact contactAt(const JsonValue& value, const Clip& clip) {
  value.allowOnly({"joint", "from_s", "to_s"});
  FootContact contact;
  contact.joint = value.at("joint").asString();
  contact.from_s = float(value.at("from_s").asNumber(0, kMaxClip_s));
  contact.to_s = float(value.at("to_s").asNumber(0, kMaxClip_s));
  if (!(contact.to_s > contact.from_s)) value.at("to_s").fail("must be later than from_s");
  if (!(contact.to_s <= clip.duration_s() + 1e-3f)) value.at("to_s").fail("lies beyond the clip's end");
  return contact;
}

void appendNumber(std::string& text, float number) {
  char buffer[32];
  text.append(buffer, shortestChars(buffer, buffer + sizeof buffer, number));
}

void appendRow(std::string& text, float time_s, const float* numbers, int count) {
  text += text.ends_with('[') ? "[" : ", [";
  appendNumber(text, time_s);
  for (int k = 0; k < count; ++k) {
    text += ", ";
    appendNumber(text, numbers[k] == 0 ? 0.f : numbers[k]);  // no -0
  }
  text += ']';
}

void appendVectors(std::string& text, const std::vector<float>& times,
                   const std::vector<Eigen::Vector3f>& values) {
  SKEL_CHECK_EQ(times.size(), values.size());
  text += '[';
  for (std::size_t k = 0; k < times.size(); ++k) appendRow(text, times[k], values[k].data(), 3);
  text += ']';
}

// To the thousandth: what a file's angle in radians is read as, and no more.
float degrees(float angle_rad) { return float(std::round(double(angle_rad) / kDegree * 1000) / 1000); }

void appendTrack(std::string& text, const JointTrack& track) {
  text += "{\"joint\": " +
          nlohmann::json(track.joint).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!track.bone.isZero()) {
    text += ", \"bone\": [";
    for (int k = 0; k < 3; ++k) {
      text += k ? ", " : "";
      appendNumber(text, track.bone[k] == 0 ? 0.f : track.bone[k]);
    }
    text += ']';
    if (track.slack_rad > 0) {
      text += ", \"slack_deg\": ";
      appendNumber(text, degrees(track.slack_rad));
    }
  }
  SKEL_CHECK_EQ(track.times_s.size(), track.rotations.size());
  if (!track.angles_rad.empty()) {
    text += ",\n     \"angles_deg\": ";
    std::vector<Eigen::Vector3f> angles = track.angles_rad;
    for (Eigen::Vector3f& angle : angles) angle = angle.unaryExpr(&degrees);
    appendVectors(text, track.times_s, angles);
  } else if (!track.times_s.empty()) {
    text += ",\n     \"rotations\": [";
    for (std::size_t k = 0; k < track.times_s.size(); ++k)
      appendRow(text, track.times_s[k], track.rotations[k].coeffs().data(), 4);
    text += ']';
  }
  if (!track.translation_times_s.empty()) {
    text += ",\n     \"translations_m\": ";
    appendVectors(text, track.translation_times_s, track.translations_m);
  }
  if (!track.scale_times_s.empty()) {
    text += ",\n     \"scales\": ";
    appendVectors(text, track.scale_times_s, track.scales);
  }
  text += '}';
}

}  // namespace

std::string clipNameIn(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string whole = name.string();
  const std::size_t ending = std::string_view(kClipFileEnding).size();
  return whole.ends_with(kClipFileEnding) ? whole.substr(0, whole.size() - ending) : name.stem().string();
}

std::string formatClip(const Clip& clip) { return formatClipKeys({clip}); }

std::string formatClipKeys(const ClipKeys& keys) {
  const Clip& clip = keys.clip;
  checkTimes(clip);
  const auto quoted = [](const std::string& name) {
    return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  std::string text = "{\n  \"format\": \"" + std::string(kFormat) +
                     "\",\n  \"version\": " + std::to_string(kVersion) +
                     ",\n  \"name\": " + quoted(clip.name);
  if (!clip.template_name.empty()) text += ",\n  \"template\": " + quoted(clip.template_name);
  if (clip.frame == ClipFrame::kBody) text += ",\n  \"frame\": \"body\"";
  const auto number = [&](const char* key, float value) {
    if (!(value > 0)) return;
    text += ",\n  \"" + std::string(key) + "\": ";
    appendNumber(text, value);
  };
  if (keys.ease != KeyEase::kNone) text += ",\n  \"ease\": " + quoted(kEaseNames[std::size_t(keys.ease)]);
  if (clip.loops != (keys.ease == KeyEase::kLoop))
    text += std::string(",\n  \"loop\": ") + (clip.loops ? "true" : "false");
  if (!clip.rest_pose.empty()) text += ",\n  \"rest_pose\": " + quoted(clip.rest_pose);
  number("duration_s", clip.least_duration_s);
  number("lead_s", clip.lead_s);
  if (!clip.root_times_s.empty()) {
    text += ",\n  \"root\": ";
    appendVectors(text, clip.root_times_s, clip.root_translations);
  }
  text += ",\n  \"tracks\": [";
  for (const JointTrack& track : clip.tracks) {
    text += text.ends_with('[') ? "\n    " : ",\n    ";
    appendTrack(text, track);
  }
  text += clip.tracks.empty() ? "]" : "\n  ]";
  if (!clip.contacts.empty()) {
    text += ",\n  \"contacts\": [";
    for (const FootContact& contact : clip.contacts) {
      text += text.ends_with('[') ? "\n    " : ",\n    ";
      text += "{\"joint\": " + quoted(contact.joint) + ", \"from_s\": ";
      appendNumber(text, contact.from_s);
      text += ", \"to_s\": ";
      appendNumber(text, contact.to_s);
      text += '}';
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

namespace {

// `eases`: even keys in place of those that ease.
ClipKeys keysIn(std::string_view text, const std::string& file, bool eases) {
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kVersion);
  root.allowOnly({"format", "version", "name", "template", "frame", "duration_s", "lead_s", "ease", "loop",
                  "rest_pose", "root", "tracks", "contacts"});
  ClipKeys keys;
  Clip& clip = keys.clip;
  clip.name = root.at("name").asString();
  if (clip.name.empty()) root.at("name").fail("must not be empty");
  if (const auto body_plan = root.find("template")) clip.template_name = body_plan->asString();
  if (const auto frame = root.find("frame")) {
    const std::string name = frame->asString();
    if (name != "picture" && name != "body") frame->fail("is \"" + name + "\", must be picture or body");
    if (name == "body") clip.frame = ClipFrame::kBody;
  }
  if (const auto duration = root.find("duration_s"))
    clip.least_duration_s = float(duration->asNumber(0, kMaxClip_s));
  keys.ease = easeAt(root.find("ease"));
  Easing easing{eases ? keys.ease : KeyEase::kNone};
  const auto loop = root.find("loop");
  clip.loops = loop ? loop->asBool() : keys.ease == KeyEase::kLoop;
  if (const auto rest_pose = root.find("rest_pose")) clip.rest_pose = rest_pose->asString();
  if (const auto path = root.find("root"))
    vectorKeys(*path, kMaxPlace, easing, clip.root_times_s, clip.root_translations);
  std::set<std::string> joints;
  for (const JsonValue& item : root.at("tracks").items()) {
    JointTrack track = trackAt(item, easing);
    if (!joints.insert(track.joint).second)
      item.at("joint").fail("\"" + track.joint + "\" has a track already");
    clip.tracks.push_back(std::move(track));
  }
  if (const auto lead = root.find("lead_s")) {
    clip.lead_s = float(lead->asNumber(0, kMaxClip_s));
    if (2 * clip.lead_s > clip.duration_s()) lead->fail("must be at most half of the clip");
  }
  if (const auto contacts = root.find("contacts")) {
    const std::vector<JsonValue> items = contacts->items();
    if (items.size() > kMaxContacts)
      contacts->fail("holds more than " + std::to_string(kMaxContacts) + " contacts");
    for (const JsonValue& item : items) clip.contacts.push_back(contactAt(item, clip));
  }
  return keys;
}

}  // namespace

Clip parseClip(std::string_view text, const std::string& file) { return keysIn(text, file, true).clip; }

ClipKeys parseClipKeys(std::string_view text, const std::string& file) { return keysIn(text, file, false); }

// By way of a file, so that it plays the same from here and from there.
Clip withEvenKeys(const ClipKeys& keys) {
  if (keys.ease == KeyEase::kNone) return keys.clip;
  ClipKeys moves;
  moves.ease = keys.ease;
  moves.clip.name = "moves";
  moves.clip.tracks = keys.clip.tracks;
  moves.clip.root_times_s = keys.clip.root_times_s;
  moves.clip.root_translations = keys.clip.root_translations;
  Clip even = parseClip(formatClipKeys(moves), keys.clip.name), result = keys.clip;
  result.tracks = std::move(even.tracks);
  result.root_times_s = std::move(even.root_times_s);
  result.root_translations = std::move(even.root_translations);
  return result;
}

Clip readClipFile(const std::string& path) { return parseClip(readFile(path), path); }

}  // namespace skel
