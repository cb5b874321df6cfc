#include "libskel/skeleton/skeleton_file.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/skeleton/joint_json.h"

namespace skel {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> textsAt(const JsonValue& value) {
  std::vector<std::string> texts;
  for (const JsonValue& item : value.items()) texts.push_back(item.asString());
  return texts;
}

Joint jointAt(const JsonValue& item, const SkeletonTemplate& body_plan, const SkeletonFile& file) {
  item.allowOnly({"name", "parent", "image", "position", "confidence", "origin"});
  Joint joint;
  joint.name = item.at("name").asString();
  const int index = body_plan.find(joint.name);
  if (index < 0)
    item.at("name").fail("\"" + joint.name + "\" is no joint of the template \"" + body_plan.name + "\"");
  joint.parent = body_plan.joints[static_cast<size_t>(index)].parent;
  const JsonValue parent = item.at("parent");
  const std::string expected =
      joint.parent < 0 ? "" : body_plan.joints[static_cast<size_t>(joint.parent)].name;
  if ((parent.isNull() ? "" : parent.asString()) != expected)
    parent.fail("must be " + (expected.empty() ? "null" : "\"" + expected + "\""));
  joint.image = imagePointAt(item.at("image"), joint.name, file.image_width, file.image_height);
  const auto position = item.at("position").asNumbers(3);
  joint.position = {position[0], position[1], position[2]};
  joint.confidence = item.at("confidence").asNumber(0, 1);
  joint.origin = originAt(item.at("origin"));
  return joint;
}

}  // namespace

std::string formatSkeletonFile(const SkeletonFile& file) {
  Json root;
  root["format"] = "skel-skeleton";
  root["version"] = 1;
  root["image"] = {{"file", jsonFromFileName(file.image_file)},
                   {"width", file.image_width},
                   {"height", file.image_height}};
  root["template"] = file.skeleton.template_name;
  root["confidence"] = rounded(file.confidence, 1000);
  root["missing"] = file.missing;
  root["warnings"] = file.warnings;
  root["mask"] = file.mask ? Json{{"file", jsonFromFileName(file.mask->file)}, {"sha256", file.mask->sha256}}
                           : Json(nullptr);
  // One joint a line, so that a person finds and mends it.
  std::string text = root.dump(2, ' ', false, Json::error_handler_t::replace);
  text.resize(text.size() - 2);
  text += ",\n  \"joints\": [";
  for (size_t i = 0; i < file.skeleton.joints.size(); ++i) {
    const Joint& joint = file.skeleton.joints[i];
    Json item;
    item["name"] = joint.name;
    item["parent"] =
        joint.parent < 0 ? Json(nullptr) : Json(file.skeleton.joints[static_cast<size_t>(joint.parent)].name);
    item["image"] = {rounded(joint.image.x(), 100), rounded(joint.image.y(), 100)};
    item["position"] = {rounded(joint.position.x(), 1e5), rounded(joint.position.y(), 1e5),
                        rounded(joint.position.z(), 1e5)};
    item["confidence"] = rounded(joint.confidence, 1000);
    item["origin"] = jointOriginName(joint.origin);
    text += (i ? ",\n    " : "\n    ") + item.dump();
  }
  return text + "\n  ]\n}\n";
}

SkeletonFile readSkeletonFile(const std::string& path, const SkeletonTemplate& body_plan) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat("skel-skeleton", 1);
  root.allowOnly(
      {"format", "version", "image", "template", "confidence", "missing", "warnings", "mask", "joints"});
  SkeletonFile file;
  const JsonValue image = root.at("image");
  image.allowOnly({"file", "width", "height"});
  file.image_file = image.at("file").asFileName();
  file.image_width = image.at("width").asInt(1, 1'000'000);
  file.image_height = image.at("height").asInt(1, 1'000'000);
  checkTemplate(root.at("template"), body_plan.name);
  file.confidence = root.at("confidence").asNumber(0, 1);
  file.missing = textsAt(root.at("missing"));
  file.warnings = textsAt(root.at("warnings"));
  if (const JsonValue mask = root.at("mask"); !mask.isNull()) {
    mask.allowOnly({"file", "sha256"});
    file.mask = SkeletonFile::Mask{mask.at("file").asFileName(), mask.at("sha256").asString()};
  }
  file.skeleton.template_name = body_plan.name;
  file.skeleton.joints.resize(body_plan.joints.size());
  for (const JsonValue& item : root.at("joints").items()) {
    const Joint joint = jointAt(item, body_plan, file);
    Joint& slot = file.skeleton.joints[static_cast<size_t>(body_plan.find(joint.name))];
    if (!slot.name.empty())
      item.at("name").fail("joint \"" + joint.name + "\" stands here for the second time");
    slot = joint;
  }
  for (size_t i = 0; i < body_plan.joints.size(); ++i)
    if (file.skeleton.joints[i].name.empty())
      root.at("joints").fail("lacks the joint \"" + body_plan.joints[i].name + "\"");
  return file;
}

bool hasEditedJoint(const std::string& path) {
  if (!std::filesystem::exists(path)) return false;
  const JsonDocument document = JsonDocument::readFile(path);
  const auto joints = document.root().find("joints");
  if (!joints) return false;
  for (const JsonValue& joint : joints->items())
    if (const auto origin = joint.find("origin");
        origin && origin->isString() && origin->asString() == "edited")
      return true;
  return false;
}

}  // namespace skel
