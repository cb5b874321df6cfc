#include "libskel/skeleton/template.h"

#include <algorithm>
#include <map>

#include "embedded/biped_template.h"
#include "embedded/quadruped_template.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

const std::map<std::string, std::string_view>& builtins() {
  static const std::map<std::string, std::string_view> all = {{"biped", embedded::biped_template},
                                                              {"quadruped", embedded::quadruped_template}};
  return all;
}

constexpr size_t kMaxJoints = 1000;

int jointAt(const SkeletonTemplate& body_plan, const JsonValue& value) {
  const int index = body_plan.find(value.asString());
  if (index < 0) value.fail("names no joint of this template: \"" + value.asString() + "\"");
  return index;
}

// One that the rules look for themselves.
int recognizedJointAt(const SkeletonTemplate& body_plan, const JsonValue& value) {
  const int index = jointAt(body_plan, value);
  if (body_plan.joints[static_cast<size_t>(index)].derived)
    value.fail("names the joint \"" + value.asString() + "\", which is derived from others");
  return index;
}

JointClass classAt(const JsonValue& value) {
  const std::string name = value.asString();
  const std::optional<JointClass> joint_class = jointClassNamed(name);
  if (!joint_class) value.fail("is \"" + name + "\", must be head, body, hand or leg");
  return *joint_class;
}

Derivation derivationAt(const SkeletonTemplate& body_plan, const JsonValue& value) {
  value.allowOnly({"rule", "from"});
  Derivation derivation;
  const std::string rule = value.at("rule").asString();
  if (rule != "midpoint" && rule != "tip")
    value.at("rule").fail("is \"" + rule + "\", must be midpoint or tip");
  derivation.rule = rule == "tip" ? DerivationRule::kTip : DerivationRule::kMidpoint;
  const auto from = value.at("from").items();
  if (from.size() != 2) value.at("from").fail("must name two joints");
  for (size_t i = 0; i < 2; ++i) derivation.from[i] = jointAt(body_plan, from[i]);
  return derivation;
}

void readJoints(SkeletonTemplate& body_plan, const JsonValue& list) {
  const std::vector<JsonValue> items = list.items();
  if (items.empty() || items.size() > kMaxJoints)
    list.fail("has " + std::to_string(items.size()) + " joints, must have 1 to " +
              std::to_string(kMaxJoints));
  for (const JsonValue& item : items) {
    item.allowOnly({"name", "parent", "mirror", "preset", "class", "class_from", "derived"});
    TemplateJoint joint;
    joint.name = item.at("name").asString();
    if (joint.name.empty()) item.at("name").fail("must not be empty");
    if (body_plan.find(joint.name) >= 0)
      item.at("name").fail("is the second joint named \"" + joint.name + "\"");
    const JsonValue parent = item.at("parent");
    if (parent.isNull() != body_plan.joints.empty())
      parent.fail("must name an earlier joint for every joint but the first, which has none");
    if (!parent.isNull()) joint.parent = jointAt(body_plan, parent);
    const auto preset = item.at("preset").asNumbers(2);
    joint.preset = {preset[0], preset[1]};
    if ((joint.preset.array() < 0).any() || (joint.preset.array() > 1).any())
      item.at("preset").fail("must lie in the figure's box, from [0, 0] to [1, 1]");
    if (const JsonValue bone_class = item.at("class"); !bone_class.isNull())
      joint.bone_class = classAt(bone_class);
    if (const auto from = item.find("class_from")) joint.class_from = from->asNumber(0, 1);
    body_plan.joints.push_back(joint);
  }
  for (size_t i = 0; i < items.size(); ++i) {
    body_plan.joints[i].mirror = jointAt(body_plan, items[i].at("mirror"));
    if (const auto derived = items[i].find("derived"))
      body_plan.joints[i].derived = derivationAt(body_plan, *derived);
  }
  for (size_t i = 0; i < items.size(); ++i)
    if (body_plan.joints[static_cast<size_t>(body_plan.joints[i].mirror)].mirror != static_cast<int>(i))
      items[i].at("mirror").fail("must name the joint that names this one");
}

}  // namespace

int SkeletonTemplate::find(std::string_view joint) const {
  for (size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == joint) return static_cast<int>(i);
  return -1;
}

bool isLeg(const SkeletonTemplate& body_plan, const TemplateLimb& limb) {
  return body_plan.joints[static_cast<std::size_t>(limb.joints[2])].name.ends_with("foot");
}

std::vector<std::array<int, 2>> SkeletonTemplate::limbPairs() const {
  std::vector<std::array<int, 2>> pairs;
  for (size_t a = 0; a < limbs.size(); ++a)
    for (size_t b = a + 1; b < limbs.size(); ++b)
      if (joints[static_cast<size_t>(limbs[a].joints[0])].mirror == limbs[b].joints[0])
        pairs.push_back({static_cast<int>(a), static_cast<int>(b)});
  return pairs;
}

SkeletonTemplate parseTemplate(std::string_view text, const std::string& file) {
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat("skel-template", 1);
  root.allowOnly(
      {"format", "version", "name", "joints", "head", "body", "limbs", "rules", "length_m", "from_side"});
  SkeletonTemplate body_plan;
  body_plan.name = root.at("name").asString();
  readJoints(body_plan, root.at("joints"));
  body_plan.head = recognizedJointAt(body_plan, root.at("head"));
  body_plan.body = recognizedJointAt(body_plan, root.at("body"));
  constexpr size_t kMostLimbs = 100;
  if (root.at("limbs").size() > kMostLimbs)
    root.at("limbs").fail("has more than " + std::to_string(kMostLimbs) + " limbs");
  for (const JsonValue& item : root.at("limbs").items()) {
    item.allowOnly({"class", "joints"});
    TemplateLimb limb;
    limb.limb_class = classAt(item.at("class"));
    if (limb.limb_class != JointClass::kHand && limb.limb_class != JointClass::kLeg)
      item.at("class").fail("must be hand or leg: the rules look for no other limbs");
    const auto joints = item.at("joints").items();
    if (joints.size() != 3) item.at("joints").fail("must name three joints");
    for (size_t i = 0; i < 3; ++i) limb.joints[i] = recognizedJointAt(body_plan, joints[i]);
    body_plan.limbs.push_back(limb);
  }
  if (const auto from_side = root.find("from_side")) body_plan.from_side = from_side->asBool();
  if (const auto length = root.find("length_m")) body_plan.length_m = length->asNumber(0, 1000);
  const JsonValue rules = root.at("rules");
  rules.allowOnly({"line_reach", "limb_probability", "limb_radius", "separation_px"});
  body_plan.rules.line_reach = rules.at("line_reach").asNumber(0, 100);
  body_plan.rules.limb_probability = rules.at("limb_probability").asNumber(0, 1);
  body_plan.rules.limb_radius = rules.at("limb_radius").asNumber(0, 100);
  body_plan.rules.separation_px = rules.at("separation_px").asNumber(0, 100);
  return body_plan;
}

SkeletonTemplate loadTemplate(const std::string& name_or_path) {
  if (const auto builtin = builtins().find(name_or_path); builtin != builtins().end())
    return parseTemplate(builtin->second, builtin->first + ".json");
  if (!name_or_path.ends_with(".json"))
    throw InputError(name_or_path, "is no template; use one of: " + joined(builtinTemplates()) +
                                       ", or a template's .json file");
  return parseTemplate(readFile(name_or_path), name_or_path);
}

std::vector<std::string> builtinTemplates() {
  std::vector<std::string> names;
  for (const auto& builtin : builtins()) names.push_back(builtin.first);
  return names;
}

Skeleton presetSkeleton(const SkeletonTemplate& body_plan, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high) {
  Skeleton skeleton;
  skeleton.template_name = body_plan.name;
  for (const TemplateJoint& preset : body_plan.joints) {
    Joint joint;
    joint.name = preset.name;
    joint.parent = preset.parent;
    joint.image = low + preset.preset.cwiseProduct(high - low);
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

}  // namespace skel
