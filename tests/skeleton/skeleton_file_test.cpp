#include "libskel/skeleton/skeleton_file.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/skeleton/rig_file.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

SkeletonFile example() {
  SkeletonFile file;
  file.image_file = "cat.png";
  file.image_width = 200;
  file.image_height = 300;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {10, 20}, {180, 290});
  file.confidence = 0.75;
  file.missing = {"left_hand"};
  file.warnings = {"two \"figures\""};
  file.mask = SkeletonFile::Mask{"cat.mask.png", std::string(64, 'a')};
  file.figure.sha256 = std::string(64, 'b');
  file.figure.found_sha256 = std::string(64, 'c');
  file.figure.facing_deg = -45;
  return file;
}

// The complaint about the example after `what` was replaced by `with`.
std::string complaint(const std::string& what, const std::string& with) {
  const TempDir dir;
  std::string text = formatSkeletonFile(example());
  const size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  text.replace(at, what.size(), with);
  writeFile(dir.file("s.json"), text);
  try {
    readSkeletonFile(dir.file("s.json"), loadTemplate("biped"));
  } catch (const InputError& error) {
    return error.problem();
  }
  return "none";
}

}  // namespace

TEST_CASE("a skeleton file comes back as it was written") {
  const TempDir dir;
  const SkeletonFile file = example();
  writeFile(dir.file("s.json"), formatSkeletonFile(file));
  const SkeletonFile back = readSkeletonFile(dir.file("s.json"), loadTemplate("biped"));
  CHECK(formatSkeletonFile(back) == formatSkeletonFile(file));
  CHECK(back.skeleton.joints.size() == 17);
  CHECK(back.skeleton.joints[3].image.isApprox(file.skeleton.joints[3].image, 1e-4));
  CHECK(back.mask->file == "cat.mask.png");
  CHECK(back.figure.found_sha256 == file.figure.found_sha256);
  CHECK(back.figure.facing_deg == -45);
}

TEST_CASE("the outline that a picture alone gives is that of the figure unless a mask was used") {
  const TempDir dir;
  SkeletonFile file = example();
  const auto found = [&] {
    writeFile(dir.file("s.json"), formatSkeletonFile(file));
    CHECK(readSkeletonFile(dir.file("s.json"), loadTemplate("biped")).foundOutline() == file.foundOutline());
    return sourceOfSkeleton(dir.file("s.json"))->found_outline_sha256;
  };
  CHECK(found() == file.figure.found_sha256);
  file.figure.found_sha256.clear();  // as before version 5
  CHECK(found() == "");
  file.mask.reset();
  CHECK(found() == file.figure.sha256);
}

TEST_CASE("a skeleton of a drawing whose name is not UTF-8") {
  const TempDir dir;
  SkeletonFile file = example();
  file.image_file = "../h\xe9ros.png";
  file.mask->file = "../h\xe9ros.mask.png";
  writeFile(dir.file("s.json"), formatSkeletonFile(file));
  const SkeletonFile again = readSkeletonFile(dir.file("s.json"), loadTemplate("biped"));
  CHECK(again.image_file == file.image_file);
  CHECK(again.mask->file == file.mask->file);
}

TEST_CASE("a skeleton file with a mistake is refused with its place") {
  CHECK(complaint("\"cat.png\"", "\"cat.png\"") == "none");
  CHECK(complaint("\"head_top\"", "\"tail\"") ==
        "joints[4].name: \"tail\" is no joint of the template \"biped\"");
  CHECK(complaint("\"image\":[95.0,198.2]", "\"image\":[200.0,198.2]") ==
        "joints[0].image: joint \"pelvis\" lies outside the image of 200x300 px");
  CHECK(complaint("\"image\":[95.0,198.2]", "\"image\":[NaN,198.2]").starts_with("is not JSON: line "));
  CHECK(complaint("\"position\":[0.0,0.0,0.0]", "\"position\":[0.0,-1e100,0.0]") ==
        "joints[0].position: is farther than 1e6 from the origin");
  CHECK(complaint("\"origin\":\"completed\"", "\"origin\":\"guessed\"") ==
        "joints[0].origin: is \"guessed\", must be recognized, completed, derived or edited");
  CHECK(complaint("\"parent\":\"pelvis\"", "\"parent\":\"neck\"") == "joints[1].parent: must be \"pelvis\"");
  CHECK(complaint("\"name\":\"left_foot\"", "\"name\":\"left_hip\"") ==
        "joints[16].parent: must be \"pelvis\"");
  CHECK(complaint("\"name\":\"body\",\"parent\":\"pelvis\"", "\"name\":\"pelvis\",\"parent\":null") ==
        "joints[1].name: joint \"pelvis\" stands here for the second time");
  CHECK(complaint("\"biped\"", "\"horse\"") ==
        "template: is \"horse\", but the template in use is \"biped\"; give the same --template");
  CHECK(complaint("\"warnings\"", "\"colour\"") == "has the unknown key \"colour\"");
}

TEST_CASE("a skeleton that lacks a joint is refused") {
  const TempDir dir;
  std::string text = formatSkeletonFile(example());
  const size_t last = text.rfind(",\n    {");
  text.erase(last, text.rfind("\n  ]") - last);
  writeFile(dir.file("s.json"), text);
  CHECK_THROWS_WITH(readSkeletonFile(dir.file("s.json"), loadTemplate("biped")),
                    dir.file("s.json") + ": joints: lacks the joint \"left_foot\"");
}

TEST_CASE("a skeleton file with more warnings than anybody reads, or more missing joints than there are") {
  // Each was held against all others.
  const auto refused = [](const SkeletonFile& file) -> std::string {
    try {
      parseSkeletonFile(formatSkeletonFile(file), "s.json", loadTemplate("biped"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  SkeletonFile file = example();
  file.warnings.clear();
  for (int i = 0; i < 101; ++i) file.warnings.push_back("look at " + std::to_string(i));
  CHECK(refused(file) == "s.json: warnings: are 101, at most 100 are read");
  file.warnings.pop_back();
  CHECK(refused(file) == "none");
  file.missing.assign(18, "left_hand");
  CHECK(refused(file) == "s.json: missing: are 18, at most 17 are read");
}

TEST_CASE("a rig whose joints stand children first is read parents first") {
  // By passes over all names it took minutes.
  constexpr int kCount = 4096;
  const auto name = [](int i) { return std::string(1000, 'n') + std::to_string(i); };
  std::string joints;
  for (int i = kCount - 1; i >= 0; --i)
    joints += (joints.empty() ? "" : ",") + std::string("{\"name\": \"") + name(i) +
              "\", \"head\": [0, 0, 0], \"tail\": [0, 1, 0], \"parent\": " +
              (i > 0 ? "\"" + name(i - 1) + "\"" : "null") + "}";
  const TempDir dir;
  writeFile(dir.file("rig.json"), "{\"joints\": [" + joints + "]}");
  const Skeleton skeleton = readRigFile(dir.file("rig.json"));
  REQUIRE(skeleton.joints.size() == kCount);
  for (int i = 0; i < kCount; ++i) {
    CHECK(skeleton.joints[std::size_t(i)].parent == i - 1);
    CHECK(skeleton.joints[std::size_t(i)].name == name(i));
  }
}

TEST_CASE("an edited joint is seen") {
  const TempDir dir;
  SkeletonFile file = example();
  CHECK_FALSE(hasEditedJoint(dir.file("s.json")));
  writeFile(dir.file("s.json"), formatSkeletonFile(file));
  CHECK_FALSE(hasEditedJoint(dir.file("s.json")));
  file.skeleton.joints[5].origin = JointOrigin::kEdited;
  writeFile(dir.file("s.json"), formatSkeletonFile(file));
  CHECK(hasEditedJoint(dir.file("s.json")));
}

TEST_CASE("the neck stayed where it was when shoulders were moved in a skeleton file") {
  const TempDir dir;
  const SkeletonTemplate plan = loadTemplate("biped");
  const Skeleton preset = example().skeleton;
  const int neck = preset.index("neck"), left = preset.index("left_shoulder"),
            right = preset.index("right_shoulder"), pelvis = preset.index("pelvis");
  nlohmann::json json = nlohmann::json::parse(formatSkeletonFile(example()));
  const auto item = [&](int joint) -> nlohmann::json& {
    for (nlohmann::json& one : json["joints"])
      if (one["name"] == preset.joints[std::size_t(joint)].name) return one;
    throw std::out_of_range("joint");
  };
  item(left)["image"] = {120, 90};
  item(right)["image"] = {60, 70};
  writeFile(dir.file("s.json"), json.dump());
  const Skeleton read = readSkeletonFile(dir.file("s.json"), plan).skeleton;
  CHECK(read.joints[std::size_t(neck)].image == Eigen::Vector2d(90, 80));
  CHECK(read.joints[std::size_t(neck)].origin == JointOrigin::kDerived);
  CHECK(read.joints[std::size_t(pelvis)].image.isApprox(preset.joints[std::size_t(pelvis)].image, 1e-4));
  item(neck)["image"] = {91, 75};  // placed as well
  writeFile(dir.file("s.json"), json.dump());
  const Skeleton placed = readSkeletonFile(dir.file("s.json"), plan).skeleton;
  CHECK(placed.joints[std::size_t(neck)].image == Eigen::Vector2d(91, 75));
  CHECK(placed.joints[std::size_t(neck)].origin == JointOrigin::kEdited);
}
