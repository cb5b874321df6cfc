#include "libskel/skeleton/template.h"

#include <algorithm>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/skeleton/hanging.h"
#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("every built-in template is a consistent tree") {
  for (const std::string& name : builtinTemplates()) {
    const SkeletonTemplate body_plan = loadTemplate(name);
    CHECK(body_plan.name == name);
    for (size_t i = 0; i < body_plan.joints.size(); ++i) {
      const TemplateJoint& joint = body_plan.joints[i];
      CHECK(joint.parent < static_cast<int>(i));
      CHECK((joint.preset.array() >= 0).all());
      CHECK((joint.preset.array() <= 1).all());
      const TemplateJoint& mirror = body_plan.joints[static_cast<size_t>(joint.mirror)];
      CHECK(mirror.preset.y() == Approx(joint.preset.y()));
      CHECK((joint.name == mirror.name || joint.preset.x() != mirror.preset.x()));
    }
    CHECK(body_plan.head >= 0);
    CHECK(body_plan.body >= 0);
  }
}

TEST_CASE("the biped has 17 joints, 14 of them recognised") {
  const SkeletonTemplate biped = loadTemplate("biped");
  CHECK(biped.joints.size() == 17);
  int recognized = 0;
  for (const TemplateJoint& joint : biped.joints) recognized += !joint.derived;
  CHECK(recognized == 14);
  CHECK(biped.limbs.size() == 4);
  for (const TemplateJoint& joint : biped.joints)
    CHECK(biped.joints[static_cast<size_t>(joint.mirror)].preset.x() == Approx(1 - joint.preset.x()));
  // Ours faces the viewer: its right hand is at the left.
  CHECK(biped.joints[static_cast<size_t>(biped.find("right_hand"))].preset.x() < 0.5);
}

TEST_CASE("the quadruped has 19 joints, 16 of them recognised") {
  const SkeletonTemplate quadruped = loadTemplate("quadruped");
  CHECK(quadruped.joints.size() == 19);
  CHECK(std::count_if(quadruped.joints.begin(), quadruped.joints.end(),
                      [](const TemplateJoint& joint) { return !joint.derived; }) == 16);
  CHECK(quadruped.limbs.size() == 4);
}

TEST_CASE("limbs that mirror each other are pairs, arms with arms, legs with legs") {
  for (const std::string& name : builtinTemplates()) {
    CAPTURE(name);
    CHECK(loadTemplate(name).limbPairs() == std::vector<std::array<int, 2>>{{0, 1}, {2, 3}});
  }
  SkeletonTemplate one_armed = loadTemplate("biped");
  one_armed.limbs.erase(one_armed.limbs.begin());
  CHECK(one_armed.limbPairs() == std::vector<std::array<int, 2>>{{1, 2}});
}

TEST_CASE("a template file that makes no sense is refused") {
  CHECK_THROWS_WITH(loadTemplate("centaur"),
                    "centaur: is no template; use one of: biped, quadruped, or a template's .json file");
  CHECK_THROWS_AS(loadTemplate("missing.json"), InputError);
  const std::string start =
      R"({"format": "skel-template", "version": 1, "name": "t", "head": "a", "body": "a",
    "limbs": [], "rules": {"line_reach": 1, "limb_probability": 0.5, "limb_radius": 0.5, "separation_px": 4}, "joints": )";
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& mirror) {
    return R"({"name": ")" + name + R"(", "parent": )" + parent + R"(, "mirror": ")" + mirror +
           R"(", "preset": [0.5, 0.5], "class": null})";
  };
  CHECK(parseTemplate(start + "[" + joint("a", "null", "a") + "]}", "t").joints.size() == 1);
  CHECK_THROWS_WITH(parseTemplate(start + "[" + joint("a", "null", "b") + "]}", "t"),
                    "t: joints[0].mirror: names no joint of this template: \"b\"");
  CHECK_THROWS_WITH(
      parseTemplate(start + "[" + joint("a", "null", "a") + "," + joint("b", "null", "b") + "]}", "t"),
      "t: joints[1].parent: must name an earlier joint for every joint but the first, which has none");
  CHECK_THROWS_WITH(
      parseTemplate(start + "[" + joint("a", "null", "a") + "," + joint("a", "\"a\"", "a") + "]}", "t"),
      "t: joints[1].name: is the second joint named \"a\"");
  CHECK_THROWS_WITH(
      parseTemplate(start + "[" + joint("a", "null", "a") + "," + joint("b", "\"a\"", "a") + "]}", "t"),
      "t: joints[1].mirror: must name the joint that names this one");
}

TEST_CASE("a template with a value that makes no sense is refused") {
  const std::string biped = readFile(SKEL_SOURCE_DIR "/libskel/skeleton/templates/biped.json");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = biped;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  CHECK(parseTemplate(biped, "t").joints.size() == 17);
  CHECK_THROWS_WITH(parseTemplate(changed("[0.5, 0.66]", "[1e300, 0.66]"), "t"),
                    "t: joints[0].preset: must lie in the figure's box, from [0, 0] to [1, 1]");
  CHECK_THROWS_WITH(parseTemplate(changed("\"name\": \"pelvis\"", "\"name\": \"\""), "t"),
                    "t: joints[0].name: must not be empty");
  CHECK_THROWS_WITH(parseTemplate(changed("\"head\": \"head\"", "\"head\": \"neck\""), "t"),
                    "t: head: names the joint \"neck\", which is derived from others");
  CHECK_THROWS_WITH(parseTemplate(changed("\"class\": \"body\"", "\"class\": \"torso\""), "t"),
                    "t: joints[1].class: is \"torso\", must be head, body, hand or leg");
  CHECK_THROWS_WITH(parseTemplate(changed("{\"class\": \"hand\"", "{\"class\": \"arm\""), "t"),
                    "t: limbs[0].class: is \"arm\", must be head, body, hand or leg");
  CHECK_THROWS_WITH(parseTemplate(changed("{\"class\": \"leg\"", "{\"class\": \"head\""), "t"),
                    "t: limbs[2].class: must be hand or leg: the rules look for no other limbs");
  std::string many;
  for (int i = 0; i < 100; ++i)
    many += R"({"class": "hand", "joints": ["right_shoulder", "right_elbow", "right_hand"]}, )";
  CHECK_THROWS_WITH(parseTemplate(changed("\"limbs\": [", "\"limbs\": [" + many), "t"),
                    "t: limbs: has more than 100 limbs");
  CHECK_THROWS_WITH(
      parseTemplate(changed("[\"right_shoulder\", \"right_elbow\"", "[\"right_shoulder\", \"right_elbo\""),
                    "t"),
      "t: limbs[0].joints[1]: names no joint of this template: \"right_elbo\"");
  CHECK_THROWS_WITH(parseTemplate(changed("[\"left_hip\", \"right_hip\"]", "[\"left_hip\", \"hip\"]"), "t"),
                    "t: joints[0].derived.from[1]: names no joint of this template: \"hip\"");
}

TEST_CASE(
    "joints that stay lost their parents where one that hangs stood before them, as Blender writes it") {
  Skeleton skeleton;
  for (const auto& [name, parent] : std::initializer_list<std::pair<const char*, int>>{{"pelvis", -1},
                                                                                       {"neck", 0},
                                                                                       {"hanging_cape_1", 1},
                                                                                       {"hanging_cape_2", 2},
                                                                                       {"head", 1},
                                                                                       {"head_top", 4}}) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    skeleton.joints.push_back(joint);
  }
  const Skeleton body = withoutHanging(skeleton);
  REQUIRE(body.joints.size() == 4);
  for (const auto& [joint, parent] : std::initializer_list<std::pair<const char*, const char*>>{
           {"neck", "pelvis"}, {"head", "neck"}, {"head_top", "head"}})
    CHECK(body.joints[std::size_t(body.index(joint))].parent == body.index(parent));
}
