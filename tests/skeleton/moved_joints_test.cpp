#include "libskel/skeleton/moved_joints.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <regex>

#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/outside_figure.h"
#include "libskel/skeleton/skeleton_file.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

// As skel writes it: positions that fit the drawing.
SkeletonFile fitting() {
  SkeletonFile file;
  file.image_file = "cat.png";
  file.image_width = file.image_height = 400;
  file.skeleton = capsuleSkeleton();
  ModelFromImage model_from_image;
  model_from_image.scale.setConstant(1.7 / 350);
  model_from_image.origin_px = {200, 380};
  for (Joint& joint : file.skeleton.joints) {
    joint.image = (joint.image * 100).array().round() / 100;
    joint.position.head<2>() = model_from_image(joint.image);
  }
  return file;
}

// The text of an earlier program, which did not say where it had found the joints.
std::string asVersion3(std::string text) {
  text = std::regex_replace(text, std::regex(",\"found\":\\[[^\\]]*\\]"), "");
  return text.replace(text.find("\"version\": 8"), 12, "\"version\": 3");
}

// The text after a person has put each joint elsewhere, where `moved` says, and said nothing.
std::string withJointsMoved(const SkeletonFile& file,
                            const std::function<Eigen::Vector2d(const Joint&)>& moved) {
  std::string text = formatSkeletonFile(file);
  for (const Joint& joint : file.skeleton.joints) {
    const size_t from = text.find("\"image\":[", text.find("{\"name\":\"" + joint.name + "\"")) + 9;
    const Eigen::Vector2d to = moved(joint);
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%.2f,%.2f", to.x(), to.y());
    text.replace(from, text.find(']', from) - from, numbers);
  }
  return text;
}

}  // namespace

TEST_CASE("hand edits are lost on the next plain run unless marked: an unmarked edit is seen") {
  const TempDir dir;
  const std::string path = dir.file("s.json");
  SkeletonFile file = fitting();
  writeFile(path, formatSkeletonFile(file));
  CHECK_FALSE(hasEditedJoint(path));

  const auto hand = static_cast<size_t>(file.skeleton.index("left_hand"));
  const auto knee = static_cast<size_t>(file.skeleton.index("right_knee"));
  file.skeleton.joints[hand].image.x() -= 4;
  file.skeleton.joints[knee].image.y() += 30;
  file.missing = {"left_hand", "left_foot"};
  writeFile(path, asVersion3(formatSkeletonFile(file)));
  CHECK(hasEditedJoint(path));
  const SkeletonFile back = readSkeletonFile(path, loadTemplate("biped"));
  for (const Joint& joint : back.skeleton.joints) {
    CAPTURE(joint.name);
    const bool moved = joint.name == "left_hand" || joint.name == "right_knee";
    CHECK((joint.origin == JointOrigin::kEdited) == moved);
  }
  CHECK(back.missing == std::vector<std::string>{"left_foot"});
}

TEST_CASE("each joint that is not where it was found counts as placed, also where all went the same way") {
  const TempDir dir;
  const std::string path = dir.file("s.json");
  const SkeletonTemplate plan = loadTemplate("biped");
  const SkeletonFile file = fitting();
  const auto placed = [&](const std::function<Eigen::Vector2d(const Joint&)>& moved) {
    writeFile(path, withJointsMoved(file, moved));
    const SkeletonFile back = readSkeletonFile(path, plan);
    std::vector<std::string> names;
    for (const Joint& joint : back.skeleton.joints)
      if (joint.origin == JointOrigin::kEdited) names.push_back(joint.name);
    CHECK(hasEditedJoint(path) == !names.empty());
    std::sort(names.begin(), names.end());
    return names;
  };
  const std::size_t all = file.skeleton.joints.size();
  CHECK(placed([](const Joint& joint) { return joint.image; }).empty());
  CHECK(placed([](const Joint& joint) -> Eigen::Vector2d { return joint.image.array() + 10; }).size() == all);
  CHECK(placed([](const Joint& joint) -> Eigen::Vector2d { return joint.image * 1.02; }).size() == all);
  // By 1 to 4 px, each another way, but two.
  std::vector<std::string> expected;
  for (const Joint& joint : file.skeleton.joints)
    if (joint.name != "neck" && joint.name != "pelvis") expected.push_back(joint.name);
  std::sort(expected.begin(), expected.end());
  CHECK(placed([&, turn = 0.](const Joint& joint) mutable -> Eigen::Vector2d {
          turn += 2.4;
          if (joint.name == "neck" || joint.name == "pelvis") return joint.image;
          return joint.image +
                 (2.5 + 1.5 * std::sin(3 * turn)) * Eigen::Vector2d(std::cos(turn), std::sin(turn));
        }) == expected);
}

TEST_CASE("joints whose positions are not known are not taken for moved ones") {
  std::vector<Eigen::Vector2d> image, nowhere;
  for (const Joint& joint : fitting().skeleton.joints) {
    image.push_back(joint.image);
    nowhere.emplace_back(0, 0);
  }
  CHECK(movedJoints(image, nowhere).empty());
  CHECK(movedJoints({image[0], image[1]}, {nowhere[0], nowhere[1]}).empty());
  CHECK(movedJoints(nowhere, image).empty());
}

TEST_CASE("moved joints are found among a thousand without trying all samples, and junk takes no longer") {
  Rng rng(4);
  std::vector<Eigen::Vector2d> image, position;
  std::vector<int> moved;
  for (int i = 0; i < 1000; ++i) {
    image.emplace_back(rng.uniform(0, 500), rng.uniform(0, 900));
    position.emplace_back(image.back().x() / 500, 1.7 - image.back().y() / 500);
    if (i % 3 != 1) continue;
    moved.push_back(i);
    image.back().x() += 9;
  }
  CHECK(movedJoints(image, position) == moved);
  while (image.size() < 50'000) {
    image.emplace_back(rng.uniform(0, 500), rng.uniform(0, 900));
    position.emplace_back(rng.uniform(), rng.uniform());
  }
  CHECK_FALSE(movedJoints(image, position).empty());
}

TEST_CASE("a skeleton file keeps its figure, and one of version 1 is of figure 1") {
  const TempDir dir;
  SkeletonFile file = fitting();
  file.figure = {3, std::string(64, 'f'), 90};
  std::string text = formatSkeletonFile(file);
  writeFile(dir.file("s.json"), text);
  const SkeletonFile back = readSkeletonFile(dir.file("s.json"), loadTemplate("biped"));
  CHECK(back.figure.number == 3);
  CHECK(back.figure.sha256 == file.figure.sha256);
  CHECK(back.figure.turned_deg == 90);
  text = asVersion3(text);
  text.replace(text.find("\"version\": 3"), 12, "\"version\": 1");
  const size_t from = text.find("  \"figure\""), to = text.find("  \"template\"");
  writeFile(dir.file("old.json"), text.erase(from, to - from));
  CHECK(readSkeletonFile(dir.file("old.json"), loadTemplate("biped")).figure.number == 1);
}

TEST_CASE("joints far outside the mask are told from those a little beside it") {
  const Plane8 mask = capsuleMask();
  Skeleton skeleton = capsuleSkeleton();
  CHECK(jointFarOutside(skeleton, mask) == nullptr);
  Joint& hand = skeleton.joints[static_cast<size_t>(skeleton.index("left_hand"))];
  hand.image.x() += 40;
  CHECK(jointFarOutside(skeleton, mask) == nullptr);
  hand.image.x() += 60;
  REQUIRE(jointFarOutside(skeleton, mask));
  CHECK(jointFarOutside(skeleton, mask)->name == "left_hand");
}
