#include "libskel/skeleton/motion_file.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json_names.h"
#include "libskel/core/standard_output.h"
#include "libskel/skeleton/joint_json.h"

namespace skel {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "skel-motion";
constexpr int kVersion = 2;  // 1 knows no source, action, key frame or frame without a picture
constexpr double kMaxTime_s = 1e6;
constexpr std::size_t kMostFrameJoints = 10'000'000;

MotionFrame frameAt(const JsonValue& value, const SkeletonTemplate& body_plan) {
  value.allowOnly({"image", "time_s", "key", "joints"});
  MotionFrame frame;
  const JsonValue image = value.at("image");
  image.allowOnly({"file", "width", "height"});
  if (const JsonValue file = image.at("file"); !file.isNull()) {
    frame.image_file = file.asFileName();
    if (frame.image_file.empty()) file.fail("must be the path of the frame's picture, or null");
  }
  if (const auto key = value.find("key")) frame.key = key->asBool();
  frame.image_width = image.at("width").asInt(1, kLongestMotionSide_px);
  frame.image_height = image.at("height").asInt(1, kLongestMotionSide_px);
  frame.time_s = value.at("time_s").asNumber(0, kMaxTime_s);
  frame.joints.resize(body_plan.joints.size());
  for (const JsonValue& item : value.at("joints").items()) {
    item.allowOnly({"name", "image", "confidence", "origin"});
    const JsonValue name = item.at("name");
    const int index = body_plan.find(name.asString());
    if (index < 0)
      name.fail("\"" + name.asString() + "\" is no joint of the template \"" + body_plan.name + "\"");
    auto& joint = frame.joints[static_cast<size_t>(index)];
    if (joint) name.fail("joint \"" + name.asString() + "\" stands here for the second time");
    joint =
        PlacedJoint{imagePointAt(item.at("image"), name.asString(), frame.image_width, frame.image_height),
                    item.at("confidence").asNumber(0, 1), originAt(item.at("origin"))};
  }
  return frame;
}

}  // namespace

std::string formatMotionFile(const MotionFile& motion, const SkeletonTemplate& body_plan) {
  const bool plain = motion.source.empty() && motion.action.empty() &&
                     std::none_of(motion.frames.begin(), motion.frames.end(), [](const MotionFrame& frame) {
                       return frame.key || frame.image_file.empty();
                     });
  const auto text = [](const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string out = "{\n  \"format\": \"" + std::string(kFormat) +
                    "\",\n  \"version\": " + std::to_string(plain ? 1 : kVersion) +
                    ",\n  \"template\": " + text(body_plan.name) +
                    ",\n  \"frame_rate\": " + text(rounded(motion.frame_rate, 1e6));
  if (!motion.source.empty()) out += ",\n  \"source\": " + text(jsonFromFileName(motion.source));
  if (!motion.action.empty()) out += ",\n  \"action\": " + text(motion.action);
  out += ",\n  \"frames\": [";
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    const MotionFrame& frame = motion.frames[f];
    SKEL_CHECK_EQ(frame.joints.size(), body_plan.joints.size());
    const Json image = {
        {"file", frame.image_file.empty() ? Json() : Json(jsonFromFileName(frame.image_file))},
        {"width", frame.image_width},
        {"height", frame.image_height}};
    out += (f ? ",\n    " : "\n    ") + std::string("{\"image\": ") + text(image) +
           ", \"time_s\": " + text(rounded(frame.time_s, 1e6)) + (frame.key ? ", \"key\": true" : "") +
           ", \"joints\": [";
    // One joint a line, so that a person finds and mends it.
    bool first = true;
    for (size_t j = 0; j < frame.joints.size(); ++j) {
      if (!frame.joints[j]) continue;
      const PlacedJoint& joint = *frame.joints[j];
      out += (first ? "\n      " : ",\n      ") +
             text({{"name", body_plan.joints[j].name},
                   {"image", {rounded(joint.image.x(), 100), rounded(joint.image.y(), 100)}},
                   {"confidence", rounded(joint.confidence, 1000)},
                   {"origin", jointOriginName(joint.origin)}});
      first = false;
    }
    out += first ? "]}" : "\n    ]}";
  }
  return out + "\n  ]\n}\n";
}

MotionFile readMotionFile(const std::string& path, const SkeletonTemplate& body_plan) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kVersion);
  root.allowOnly({"format", "version", "template", "frame_rate", "source", "action", "frames"});
  checkTemplate(root.at("template"), body_plan.name);
  MotionFile motion;
  motion.frame_rate = root.at("frame_rate").asNumber(kMinFrameRate, kMaxFrameRate);
  if (const auto source = root.find("source")) motion.source = source->asFileName();
  if (const auto action = root.find("action")) motion.action = action->asString();
  const JsonValue frames = root.at("frames");
  const std::vector<JsonValue> items = frames.items();
  if (items.size() > kMostFrameJoints / std::max<std::size_t>(1, body_plan.joints.size()))
    frames.fail("are " + std::to_string(items.size()) + ", each with " +
                std::to_string(body_plan.joints.size()) + " joints of the template: too many");
  for (const JsonValue& item : items) {
    motion.frames.push_back(frameAt(item, body_plan));
    const size_t count = motion.frames.size();
    if (count > 1 &&
        rounded(motion.frames[count - 1].time_s, 1e6) <= rounded(motion.frames[count - 2].time_s, 1e6))
      item.at("time_s").fail("must be later than that of the frame before");
  }
  if (motion.frames.empty()) root.at("frames").fail("is empty");
  return motion;
}

std::string templateOfMotion(const std::string& path) {
  const JsonDocument document = JsonDocument::readFile(path);
  document.root().checkFormat(kFormat, kVersion);
  return document.root().at("template").asString();
}

void requireNoEdits(const std::string& path, const SkeletonTemplate& body_plan) {
  if (std::filesystem::is_directory(path)) throw OutputError(path, "is a folder; name a file by -o");
  if (!isFileToReplace(path)) return;
  const LookAtOutputs look;
  for (const MotionFrame& frame : readMotionFile(path, body_plan).frames)
    for (const auto& joint : frame.joints)
      if (joint && joint->origin == JointOrigin::kEdited)
        throw InputError(
            path,
            "holds joints that were edited by hand; write to another file by -o, or give --force "
            "to lose them");
}

}  // namespace skel
