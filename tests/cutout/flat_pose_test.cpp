#include "libskel/cutout/flat_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/animation/clip_library.h"
#include "tests/support/catch.h"
#include "tests/support/clips_on_drawings.h"

using namespace skel;

namespace {

RiggedDrawing rigged(const std::string& path, const std::string& body_plan) {
  const std::vector<Clip> clips = clipsFor(builtinClips(), loadTemplate(body_plan));
  return rigWithClips(std::string(SKEL_SOURCE_DIR) + "/datasets/" + path, body_plan, clips);
}

FlatPose poseAt(const RiggedDrawing& drawing, const Clip& clip, float time_s) {
  const RiggedCharacter& character = drawing.character;
  return flatPose(character.skeleton, drawing.body_plan,
                  posedFromRest(character.skeleton, samplePose(clip, character.skeleton, time_s),
                                heightOf(character.mesh)));
}

}  // namespace

TEST_CASE("at rest every joint is where it was drawn") {
  const RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  const std::vector<Eigen::Quaternionf> still(drawing.character.skeleton.joints.size(),
                                              Eigen::Quaternionf::Identity());
  const FlatPose pose = flatPose(drawing.character.skeleton, drawing.body_plan,
                                 posedFromRest(drawing.character.skeleton, still));
  for (std::size_t j = 0; j < pose.rest.size(); ++j) {
    CHECK((pose.place[j] - pose.rest[j]).norm() < 1e-5);
    CHECK(std::abs(pose.turn_rad[j]) < 1e-5);
  }
}

TEST_CASE("bones keep their length on the screen, whatever they do in space") {
  for (const auto& [path, plan] :
       {std::pair("characters/cap_boy.png", "biped"), std::pair("characters/zombie.png", "biped"),
        std::pair("animals/cloud_sheep.png", "quadruped")}) {
    CAPTURE(path);
    const RiggedDrawing drawing = rigged(path, plan);
    REQUIRE(drawing.found());
    for (const Clip& clip : drawing.clips)
      for (int k = 0; k < 8; ++k) {
        const FlatPose pose = poseAt(drawing, clip, clip.duration_s() * float(k) / 8);
        for (std::size_t j = 1; j < pose.rest.size(); ++j) {
          const std::size_t parent = std::size_t(drawing.character.skeleton.joints[j].parent);
          CHECK((pose.place[j] - pose.place[parent]).norm() ==
                Approx((pose.rest[j] - pose.rest[parent]).norm()).margin(1e-9));
        }
      }
  }
}

TEST_CASE(
    "flat knees and elbows fold no farther than both halves of the limb are seen, or as they are drawn") {
  const RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  const Skeleton& skeleton = drawing.character.skeleton;
  double most = 0;
  for (const Clip& clip : drawing.clips)
    for (int k = 0; k < 24; ++k) {
      const FlatPose pose = poseAt(drawing, clip, clip.duration_s() * float(k) / 24);
      for (const TemplateLimb& limb : drawing.body_plan.limbs) {
        std::array<std::size_t, 3> joints;
        for (std::size_t i = 0; i < 3; ++i)
          joints[i] = std::size_t(skeleton.index(drawing.body_plan.joints[std::size_t(limb.joints[i])].name));
        const auto bend = [&](const std::vector<Eigen::Vector2d>& at) {
          const Eigen::Vector2d upper = at[joints[1]] - at[joints[0]], lower = at[joints[2]] - at[joints[1]];
          return std::acos(std::clamp(upper.normalized().dot(lower.normalized()), -1., 1.)) * 180 / M_PI;
        };
        const double folded = bend(pose.place), drawn = bend(pose.rest);
        CHECK(folded < std::max(75., drawn) + 35);
        most = std::max(most, folded);
      }
    }
  CHECK(most > 80);
}

TEST_CASE("an elbow that goes through folded does not jump to the other side") {
  RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  Skeleton& skeleton = drawing.character.skeleton;
  for (Joint& joint : skeleton.joints) joint.position.z() = 0;
  const std::size_t elbow = std::size_t(skeleton.index("left_elbow"));
  std::vector<Eigen::Quaternionf> turns(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  double before = 0, most = 0;
  for (int step = 0; step <= 72; ++step) {
    const double angle_rad = step * M_PI / 36;
    turns[elbow] = Eigen::Quaternionf(Eigen::AngleAxisf(float(angle_rad), Eigen::Vector3f::UnitZ()));
    const double now = flatPose(skeleton, drawing.body_plan, posedFromRest(skeleton, turns)).turn_rad[elbow];
    if (step > 0) most = std::max(most, std::abs(std::remainder(now - before, 2 * M_PI)));
    before = now;
  }
  CHECK(most < 30 * M_PI / 180);
}

TEST_CASE("the lowest foot is on the screen where it is in space") {
  const RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  const RiggedCharacter& character = drawing.character;
  for (const Clip& clip : drawing.clips) {
    CAPTURE(clip.name);
    for (int k = 0; k < 16; ++k) {
      const float time_s = clip.duration_s() * float(k) / 16;
      const FlatPose pose = poseAt(drawing, clip, time_s);
      const auto posed = posedJoints(
          character.skeleton, posedFromRest(character.skeleton, samplePose(clip, character.skeleton, time_s),
                                            heightOf(character.mesh)));
      double flat = 1e9, space = 1e9;
      for (const char* foot : {"left_foot", "right_foot"}) {
        const std::size_t j = std::size_t(character.skeleton.index(foot));
        flat = std::min(flat, pose.place[j].y()), space = std::min(space, double(posed[j].y()));
      }
      CHECK(flat == Approx(space).margin(1e-5));
    }
  }
}

TEST_CASE("a bone that points at the viewer goes with the one that carries it") {
  RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  Skeleton& skeleton = drawing.character.skeleton;
  for (Joint& joint : skeleton.joints) joint.position.z() = 0;
  const std::size_t shoulder = std::size_t(skeleton.index("left_shoulder")),
                    elbow = std::size_t(skeleton.index("left_elbow"));
  std::vector<Eigen::Quaternionf> turns(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  const Eigen::Vector3f bone =
      (skeleton.joints[elbow].position - skeleton.joints[shoulder].position).cast<float>();
  for (const float aside : {-0.05f, 0.05f}) {
    turns[shoulder] = Eigen::Quaternionf::FromTwoVectors(bone, Eigen::Vector3f(aside, 0.02f, 1));
    const FlatPose pose = flatPose(skeleton, drawing.body_plan, posedFromRest(skeleton, turns));
    CHECK(std::abs(pose.turn_rad[shoulder]) < 0.01);
  }
}

TEST_CASE("a head that was turned to the side rolled to the shoulder, as its bone leads into the depth") {
  RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  Skeleton& skeleton = drawing.character.skeleton;
  const std::size_t head = std::size_t(skeleton.index("head")), top = std::size_t(skeleton.index("head_top"));
  skeleton.joints[top].position = skeleton.joints[head].position + Eigen::Vector3d(0, 0.05, 0.056);
  std::vector<Eigen::Quaternionf> turns(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  const auto rollOf = [&](const Eigen::Vector3f& axis) {
    turns[head] = Eigen::AngleAxisf(0.47f, axis);
    return flatPose(skeleton, drawing.body_plan, posedFromRest(skeleton, turns)).turn_rad[head];
  };
  CHECK(std::abs(rollOf(Eigen::Vector3f::UnitY())) < 0.01);
  CHECK(rollOf(Eigen::Vector3f::UnitZ()) == Approx(0.47).margin(1e-3));
}

TEST_CASE("a calmed pose turns bones by the shares that are asked for, and stays on the ground") {
  const RiggedDrawing drawing = rigged("characters/cap_boy.png", "biped");
  const Skeleton& skeleton = drawing.character.skeleton;
  const Clip& run = clipNamed(drawing.clips, "run");
  const FlatPose pose = poseAt(drawing, run, run.duration_s() / 3);
  const FlatPose same = calmed(pose, skeleton, drawing.body_plan, 1, 1);
  for (std::size_t j = 0; j < pose.place.size(); ++j) CHECK((same.place[j] - pose.place[j]).norm() < 1e-9);
  const FlatPose calm = calmed(pose, skeleton, drawing.body_plan, .25, .5);
  const auto own = [&](const FlatPose& of, const char* joint) {
    const auto j = std::size_t(skeleton.index(joint));
    return of.turn_rad[j] - of.turn_rad[std::size_t(skeleton.joints[j].parent)];
  };
  REQUIRE(std::abs(own(pose, "left_hip")) > .1);
  for (const char* joint : {"left_hip", "right_knee"})
    CHECK(own(calm, joint) == Approx(.25 * own(pose, joint)).margin(1e-9));
  for (const char* joint : {"left_shoulder", "right_elbow", "neck"})
    CHECK(own(calm, joint) == Approx(.5 * own(pose, joint)).margin(1e-9));
  const auto lowest = [&](const FlatPose& of) {
    return std::min(of.place[std::size_t(skeleton.index("left_foot"))].y(),
                    of.place[std::size_t(skeleton.index("right_foot"))].y());
  };
  CHECK(lowest(calm) == Approx(lowest(pose)));
}
