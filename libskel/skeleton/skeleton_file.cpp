#include "libskel/skeleton/skeleton_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/joint_json.h"
#include "libskel/skeleton/mark_placed.h"
#include "libskel/skeleton/moved_joints.h"

namespace skel {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSkeletonVersion = 8;         // 3: without `found`, 4: without `found_sha256`, 5: without
                                            // `labels.joints`, 6: without `limbs`, 7: without `facing_deg`
constexpr std::size_t kMostWarnings = 100;  // all are shown, each once; skel gives a handful
constexpr int kLongestImageSide_px = 1'000'000;
constexpr double kUnmoved_px = 0.005;  // files keep hundredths of a pixel

std::vector<std::string> textsAt(const JsonValue& value, std::size_t most) {
  if (value.size() > most)
    value.fail("are " + std::to_string(value.size()) + ", at most " + std::to_string(most) + " are read");
  std::vector<std::string> texts;
  for (const JsonValue& item : value.items()) texts.push_back(item.asString());
  return texts;
}

Joint jointAt(const JsonValue& item, const SkeletonTemplate& body_plan, const SkeletonFile& file) {
  item.allowOnly({"name", "parent", "image", "position", "confidence", "origin", "found"});
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
  joint.position = positionAt(item.at("position"));
  joint.confidence = item.at("confidence").asNumber(0, 1);
  joint.origin = originAt(item.at("origin"));
  return joint;
}

SkeletonFile::Mask paintedAt(const JsonValue& given) {
  given.allowOnly({"file", "sha256", "before"});
  const auto before = given.find("before");
  return {given.at("file").asFileName(), given.at("sha256").asString(), before && before->asBool()};
}

SkeletonFile::Labels labelsAt(const JsonValue& given, int image_width, int image_height) {
  given.allowOnly({"file", "sha256", "joints"});
  SkeletonFile::Labels labels{given.at("file").asFileName(), given.at("sha256").asString()};
  if (const auto joints = given.find("joints"))
    for (const std::string& name : joints->keys())
      labels.joints[name] = imagePointAt(joints->at(name), name, image_width, image_height);
  return labels;
}

SkeletonFile::Figure figureAt(const JsonValue& value) {
  value.allowOnly({"number", "sha256", "turned", "found_sha256", "facing_deg"});
  SkeletonFile::Figure figure;
  figure.number = value.at("number").asInt(1, 9999);
  figure.sha256 = value.at("sha256").asString();
  figure.turned_deg = value.at("turned").asInt(0, 359);
  if (const auto hash = value.find("found_sha256")) figure.found_sha256 = hash->asString();
  if (const auto facing = value.find("facing_deg")) figure.facing_deg = facing->asNumber(-180, 180);
  return figure;
}

// Where the joints of a file are, in it and in the model, and where the program had found them.
struct JointPlaces {
  std::vector<Eigen::Vector2d> image, position;
  std::vector<std::optional<Eigen::Vector2d>> found;
};

// The indices of joints that are no longer where they were found; of a file that does not say where that was,
// of those that do not fit the others.
std::vector<int> movedIn(const JointPlaces& places) {
  const auto& found = places.found;
  if (std::none_of(found.begin(), found.end(), [](const auto& place) { return place.has_value(); }))
    return movedJoints(places.image, places.position);
  std::vector<int> moved;
  for (size_t j = 0; j < found.size(); ++j)
    if (found[j] && (places.image[j] - *found[j]).norm() > kUnmoved_px) moved.push_back(static_cast<int>(j));
  return moved;
}

void markPlacedJoints(SkeletonFile& file, std::vector<std::optional<Eigen::Vector2d>> found) {
  JointPlaces places;
  for (const Joint& joint : file.skeleton.joints) {
    places.image.push_back(joint.image);
    places.position.push_back(joint.position.head<2>());
  }
  places.found = std::move(found);
  const std::vector<int> placed = movedIn(places);
  file.confidence = markPlaced(file.skeleton, placed, file.confidence);
  for (const int joint : placed)
    std::erase(file.missing, file.skeleton.joints[static_cast<size_t>(joint)].name);
}

std::vector<double> numbersAt(const JsonValue& joint, const char* key) {
  std::vector<double> result;
  if (const auto value = joint.find(key); value && value->isArray())
    for (const JsonValue& item : value->items())
      if (item.isNumber()) result.push_back(item.asNumber());
  return result;
}

// The places of joints by their names; joints that have none are left out.
std::map<std::string, std::vector<double>> placesIn(const std::string& path) {
  const LookAtOutputs look;
  const JsonDocument document = JsonDocument::readFile(path);
  std::map<std::string, std::vector<double>> places;
  if (const auto joints = document.root().find("joints"))
    for (const JsonValue& joint : joints->items())
      if (const auto name = joint.find("name"); name && name->isString())
        if (std::vector<double> place = numbersAt(joint, "image"); place.size() == 2)
          places[name->asString()] = std::move(place);
  return places;
}

}  // namespace

void noteSkeletonFiles(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (file.ends_with(kSkeletonFileEnding)) noteInput(file);
}

std::string formatSkeletonFile(const SkeletonFile& file) {
  Json root;
  root["format"] = "skel-skeleton";
  root["version"] = kSkeletonVersion;
  root["image"] = {{"file", jsonFromFileName(file.image_file)},
                   {"width", file.image_width},
                   {"height", file.image_height}};
  if (!file.image_sha256.empty()) root["image"]["sha256"] = file.image_sha256;
  root["figure"] = {
      {"number", file.figure.number}, {"sha256", file.figure.sha256}, {"turned", file.figure.turned_deg}};
  if (file.mask && !file.figure.found_sha256.empty())
    root["figure"]["found_sha256"] = file.figure.found_sha256;
  if (file.figure.facing_deg) root["figure"]["facing_deg"] = rounded(*file.figure.facing_deg, 100);
  root["template"] = file.skeleton.template_name;
  root["confidence"] = rounded(file.confidence, 1000);
  root["missing"] = file.missing;
  root["warnings"] = file.warnings;
  const auto source = [](const auto& given) {
    return Json{{"file", jsonFromFileName(given.file)}, {"sha256", given.sha256}};
  };
  const auto painted = [&](const SkeletonFile::Mask& mask) {
    Json json = source(mask);
    if (mask.before) json["before"] = true;
    return json;
  };
  root["mask"] = file.mask ? painted(*file.mask) : Json(nullptr);
  if (file.limbs) root["limbs"] = painted(*file.limbs);
  if (file.labels) {
    root["labels"] = source(*file.labels);
    for (const auto& [name, place] : file.labels->joints)
      root["labels"]["joints"][name] = {rounded(place.x(), 100), rounded(place.y(), 100)};
  }
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
    if (joint.origin != JointOrigin::kEdited) item["found"] = item["image"];
    text += (i ? ",\n    " : "\n    ") + item.dump();
  }
  return text + "\n  ]\n}\n";
}

std::string templateOfSkeleton(std::string_view text, const std::string& path) {
  const JsonDocument document = JsonDocument::parse(text, path);
  document.root().checkFormat("skel-skeleton", kSkeletonVersion);
  return document.root().at("template").asString();
}

SkeletonFile readSkeletonFile(const std::string& path, const SkeletonTemplate& body_plan) {
  return parseSkeletonFile(readFile(path), path, body_plan);
}

SkeletonFile parseSkeletonFile(std::string_view text, const std::string& path,
                               const SkeletonTemplate& body_plan) {
  const JsonDocument document = JsonDocument::parse(text, path);
  const JsonValue root = document.root();
  root.checkFormat("skel-skeleton", kSkeletonVersion);
  root.allowOnly({"format", "version", "image", "figure", "template", "confidence", "missing", "warnings",
                  "mask", "limbs", "labels", "joints"});
  SkeletonFile file;
  const JsonValue image = root.at("image");
  image.allowOnly({"file", "width", "height", "sha256"});
  file.image_file = image.at("file").asFileName();
  file.image_width = image.at("width").asInt(1, kLongestImageSide_px);
  file.image_height = image.at("height").asInt(1, kLongestImageSide_px);
  if (const auto hash = image.find("sha256")) file.image_sha256 = hash->asString();
  if (const auto figure = root.find("figure")) file.figure = figureAt(*figure);  // not in version 1
  checkTemplate(root.at("template"), body_plan.name);
  file.confidence = root.at("confidence").asNumber(0, 1);
  file.missing = textsAt(root.at("missing"), body_plan.joints.size());
  file.warnings = textsAt(root.at("warnings"), kMostWarnings);
  if (const JsonValue mask = root.at("mask"); !mask.isNull()) file.mask = paintedAt(mask);
  if (const auto limbs = root.find("limbs")) file.limbs = paintedAt(*limbs);
  if (const auto labels = root.find("labels"))
    file.labels = labelsAt(*labels, file.image_width, file.image_height);
  file.skeleton.template_name = body_plan.name;
  file.skeleton.joints.resize(body_plan.joints.size());
  std::vector<std::optional<Eigen::Vector2d>> places_found(body_plan.joints.size());
  for (const JsonValue& item : root.at("joints").items()) {
    const Joint joint = jointAt(item, body_plan, file);
    const auto index = static_cast<size_t>(body_plan.find(joint.name));
    Joint& slot = file.skeleton.joints[index];
    if (!slot.name.empty())
      item.at("name").fail("joint \"" + joint.name + "\" stands here for the second time");
    slot = joint;
    if (const auto found = item.find("found"))
      places_found[index] = imagePointAt(*found, joint.name, file.image_width, file.image_height);
  }
  for (size_t i = 0; i < body_plan.joints.size(); ++i)
    if (file.skeleton.joints[i].name.empty())
      root.at("joints").fail("lacks the joint \"" + body_plan.joints[i].name + "\"");
  markPlacedJoints(file, std::move(places_found));
  followPlaced(file.skeleton, body_plan);
  return file;
}

SkeletonSource readSkeletonSource(const std::string& path) {
  const LookAtOutputs look;
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat("skel-skeleton", kSkeletonVersion);
  SkeletonSource source;
  const JsonValue image = root.at("image");
  source.image_file = image.at("file").asFileName();
  source.image_width = image.at("width").asInt(1, kLongestImageSide_px);
  source.image_height = image.at("height").asInt(1, kLongestImageSide_px);
  if (const auto hash = image.find("sha256")) source.image_sha256 = hash->asString();
  if (const JsonValue mask = root.at("mask"); !mask.isNull()) source.mask = paintedAt(mask);
  if (const auto limbs = root.find("limbs")) source.limbs = paintedAt(*limbs);
  if (const auto labels = root.find("labels"))
    source.labels = labelsAt(*labels, source.image_width, source.image_height);
  if (const auto json = root.find("figure")) {
    const SkeletonFile::Figure figure = figureAt(*json);
    source.outline_sha256 = figure.sha256;
    source.found_outline_sha256 = source.mask ? figure.found_sha256 : figure.sha256;
    source.number = figure.number;
    source.facing_deg = figure.facing_deg;
  }
  if (const auto warnings = root.find("warnings")) source.warnings = textsAt(*warnings, kMostWarnings);
  return source;
}

std::optional<SkeletonSource> sourceOfSkeleton(const std::string& path) {
  if (std::error_code unknown; !std::filesystem::exists(path, unknown)) return std::nullopt;
  try {
    return readSkeletonSource(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::size_t editedJoints(const std::string& path) {
  if (std::error_code unknown; !std::filesystem::exists(path, unknown)) return 0;
  const LookAtOutputs look;
  const JsonDocument document = JsonDocument::readFile(path);
  const auto joints = document.root().find("joints");
  if (!joints) return 0;
  std::size_t said = 0;
  JointPlaces places;
  for (const JsonValue& joint : joints->items()) {
    if (const auto origin = joint.find("origin");
        origin && origin->isString() && origin->asString() == "edited") {
      ++said;
      continue;
    }
    const auto at = numbersAt(joint, "image"), to = numbersAt(joint, "position");
    if (at.size() != 2 || to.size() != 3) continue;
    places.image.emplace_back(at[0], at[1]);
    places.position.emplace_back(to[0], to[1]);
    places.found.emplace_back();
    if (const auto found = numbersAt(joint, "found"); found.size() == 2)
      places.found.back() = Eigen::Vector2d(found[0], found[1]);
  }
  return said + movedIn(places).size();
}

bool hasUnknownJoint(const std::string& path) {
  static const BodyPlans plans = bodyPlans("auto");
  if (std::error_code unknown; !std::filesystem::exists(path, unknown)) return false;
  const LookAtOutputs look;
  const JsonDocument document = JsonDocument::readFile(path);
  const auto body_plan = document.root().find("template"), joints = document.root().find("joints");
  if (!body_plan || !body_plan->isString() || !joints) return false;
  const SkeletonTemplate* plan = findPlan(body_plan->asString(), plans);
  if (!plan) return false;
  for (const JsonValue& joint : joints->items())
    if (const auto name = joint.find("name"); name && name->isString() && plan->find(name->asString()) < 0)
      return true;
  return false;
}

bool isSamePlace(const Eigen::Vector2d& place, const Eigen::Vector2d& other) {
  return (place - other).cwiseAbs().maxCoeff() < 3 * kUnmoved_px;
}

bool haveSameJoints(const std::string& path, const std::string& other_path) {
  const auto near = [](double a, double b) { return std::abs(a - b) < 2 * kUnmoved_px; };
  const auto places = placesIn(path), others = placesIn(other_path);
  return std::equal(
      places.begin(), places.end(), others.begin(), others.end(), [&](const auto& a, const auto& b) {
        return a.first == b.first && near(a.second[0], b.second[0]) && near(a.second[1], b.second[1]);
      });
}

}  // namespace skel
