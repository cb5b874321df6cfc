#include "libskel/animation/retarget_motion.h"

#include <cmath>
#include <map>
#include <numbers>

#include "libskel/animation/bone_turn.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/skeleton/template.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

using Eigen::Vector3f;

const std::string kMotions = SKEL_SOURCE_DIR "/tests/data/motions/";
const std::vector<std::string> kFamilies = {"cmu",    "mixamo", "mixamo_prefixed",   "rokoko",
                                            "rigify", "vrm",    "animated_drawings", "nameless"};

RetargetedMotion retargeted(const std::string& family, const Skeleton& target) {
  const std::string path = kMotions + family + ".bvh";
  return retargetMotion(readBvh(path), path, target, shapeOfBones(target));
}

std::map<std::string, Vector3f> places(const Clip& clip, const Skeleton& skeleton, float time_s) {
  const Pose pose = samplePose(clip, skeleton, time_s);
  std::vector<Eigen::Quaternionf> globals;
  std::vector<Vector3f> at;
  std::map<std::string, Vector3f> result;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const int parent = joint.parent;
    const Vector3f rest = joint.position.cast<float>();
    at.push_back(parent < 0
                     ? Vector3f(rest + 1.7f * pose.root_translation)
                     : Vector3f(at[parent] +
                                globals[parent] * (rest - skeleton.joints[parent].position.cast<float>())));
    globals.push_back(parent < 0 ? pose.rotations[j] : globals[parent] * pose.rotations[j]);
    result[joint.name] = at.back();
  }
  return result;
}

Vector3f bone(std::map<std::string, Vector3f>& at, const std::string& from, const std::string& to) {
  return (at[to] - at[from]).normalized();
}

// The same motion with another rest pose: every joint's axes are turned by `turns` beforehand.
BvhMotion withRestPose(BvhMotion motion, const std::vector<Eigen::Quaterniond>& turns) {
  const Skeleton rest = motion.skeleton;
  std::vector<JointTrack*> tracks(rest.joints.size(), nullptr);
  for (JointTrack& track : motion.clip.tracks) tracks[std::size_t(rest.index(track.joint))] = &track;
  for (std::size_t j = 0; j < rest.joints.size(); ++j) {
    const int parent = rest.joints[j].parent;
    Joint& joint = motion.skeleton.joints[j];
    motion.tips[j] = turns[j].conjugate() * motion.tips[j];
    const Eigen::Quaterniond back =
        parent < 0 ? Eigen::Quaterniond::Identity() : turns[std::size_t(parent)].conjugate();
    if (parent >= 0)
      joint.position = motion.skeleton.joints[std::size_t(parent)].position +
                       back * (joint.position - rest.joints[std::size_t(parent)].position);
    if (!tracks[j]) continue;
    for (Eigen::Quaternionf& rotation : tracks[j]->rotations)
      rotation = (back * rotation.cast<double>() * turns[j]).cast<float>();
    for (Vector3f& place : tracks[j]->translations_m) place = (back * place.cast<double>()).cast<float>();
  }
  return motion;
}

// Five rest poses that nobody stands in: all bones along x (as Rokoko's), all along -y, all along z, each
// bone somewhere, and each bone where it was but turned about itself.
std::vector<Eigen::Quaterniond> oddRestPose(const Skeleton& skeleton, int kind) {
  std::vector<Eigen::Quaterniond> turns;
  const std::vector<Eigen::Vector3d> bones = restBones(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Eigen::Vector3d& bone = bones[j];
    const Eigen::Vector3d goals[] = {
        Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
        Eigen::Vector3d(std::sin(3.0 * double(j)), std::cos(5.0 * double(j)), std::sin(7.0 * double(j) + 1))
            .normalized()};
    turns.push_back(kind < 4 ? Eigen::Quaterniond::FromTwoVectors(goals[kind], bone)
                             : Eigen::Quaterniond(Eigen::AngleAxisd(1.0 + double(j), bone)));
  }
  return turns;
}

const char kTiny[] =
    "HIERARCHY\nROOT hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
    "Yrotation\n JOINT leg\n {\n  OFFSET 0 -1 0\n  CHANNELS 1 Xrotation\n  End Site\n  {\n   OFFSET 0 -1 0\n "
    " }\n }\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.5\n0 1 0 0 0 0 0\n0 2 0 90 0 0 30\n";

}  // namespace

TEST_CASE("a BVH is its offsets, its channels in their order, its frames") {
  const BvhMotion motion = parseBvh(kTiny, "tiny.bvh");
  REQUIRE(motion.skeleton.joints.size() == 2);
  CHECK(motion.skeleton.joints[1].position == Eigen::Vector3d(0, -1, 0));
  CHECK(motion.tips[1] == Eigen::Vector3d(0, -1, 0));
  CHECK(motion.clip.duration_s() == 0.5f);
  const Pose pose = samplePose(motion.clip, motion.skeleton, 0.5f);
  CHECK((pose.rotations[0] * Vector3f::UnitX() - Vector3f::UnitY()).norm() < 1e-6f);
  CHECK(pose.translations_m[0] == Vector3f(0, 2, 0));
}

TEST_CASE("a BVH that makes no sense is refused with the line") {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& problem) {
    std::string text = kTiny;
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    CHECK_THROWS_WITH(parseBvh(text, "bad.bvh"), "bad.bvh: " + problem);
  };
  refused("HIERARCHY", "HIRARCHY", "line 1: has \"HIRARCHY\" where \"HIERARCHY\" should be");
  refused("JOINT leg", "JOINT hips", "line 6: is the second joint named \"hips\"");
  refused("Yposition", "Wposition",
          "line 5: has the channel \"Wposition\"; there are: Xposition … Zrotation");
  refused("Yposition", "Xposition", "line 5: has the channel \"Xposition\" twice");
  refused("OFFSET 0 -1 0", "OFFSET 0 nan 0", "line 8: has \"nan\" where a number should be");
  refused("Frames: 2", "Frames: 3", "line 21: ends after 2 of 3 frames");
  refused("Frames: 2", "Frames: 1", "line 20: goes on after its last frame");
  refused("0 2 0 90 0 0 30", "0 2 0 90 0", "line 21: has its end where a number should be");
  refused("Frame Time: 0.5", "Frame Time: 0", "line 18: has a frame time outside 0 to 100 s");
  refused(" }\n}\nMOTION", " }\nMOTION",
          "line 15: has \"MOTION\" where \"JOINT\", \"End Site\" or \"}\" should be");
}

// A pose for each joint of each frame: gigabytes of a small file.
TEST_CASE("a BVH of many frames whose joints have no channels is refused with the line") {
  std::string text = "HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  for (int joint = 0; joint < 200; ++joint)
    text += "JOINT j" + std::to_string(joint) +
            "\n{\nOFFSET 0 1 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n";
  text += "}\nMOTION\nFrames: 60000\nFrame Time: 0.001\n";
  CHECK_THROWS_WITH(parseBvh(text, "many.bvh"),
                    Catch::Matchers::Contains("many.bvh: line ") &&
                        Catch::Matchers::Contains("has 60000 frames of 201 joints; at most 49751"));
}

TEST_CASE("every family's joints are found, and by shape where the names say nothing") {
  for (const std::string& family : kFamilies) {
    CAPTURE(family);
    const RetargetedMotion result = retargeted(family, figureSkeleton());
    CHECK(result.match.by_shape == (family == "nameless"));
    std::vector<std::string> left = result.match.ours_left;
    std::erase(left, "head_top");
    std::erase(left, "body");  // one family has no joint between hips and chest
    CHECK(left.empty());
    for (const auto& [ours, theirs] : result.match.joints) {
      CAPTURE(ours, theirs);
      const bool is_left = theirs.find("eft") != std::string::npos || theirs.ends_with(".L");
      const bool is_right = theirs.find("ight") != std::string::npos || theirs.ends_with(".R");
      CHECK(is_left == ours.starts_with("left_"));
      CHECK(is_right == ours.starts_with("right_"));
    }
  }
}

TEST_CASE("an animal whose tail is as long as a leg had neither arms nor legs for a person's motion") {
  Skeleton animal = presetSkeleton(loadTemplate("quadruped"), {0, 0}, {1, 1});
  const auto at = [&](const std::string& name) -> Eigen::Vector3d& {
    return animal.joints[std::size_t(animal.index(name))].position;
  };
  for (Joint& joint : animal.joints) joint.position = {joint.image.x(), 1 - joint.image.y(), 0};
  at("left_hind_foot").y() -= 0.1;
  at("tail") = at("tail_root") + Eigen::Vector3d(0.45, 0, 0);  // as the right leg
  const JointRoles roles = findJointRoles(animal);
  CHECK_FALSE(roles.by_shape);
  for (const std::string side : {"left_", "right_"})
    for (const auto& [role, joint] :
         {std::pair("shoulder", "shoulder"), std::pair("elbow", "elbow"), std::pair("hand", "front_foot"),
          std::pair("hip", "hip"), std::pair("knee", "knee"), std::pair("foot", "hind_foot")})
      CHECK(roles.joint(side + role) == animal.find(side + joint));
  CHECK(retargeted("cmu", animal).match.joints.size() == kJointRoles.size());
}

TEST_CASE("one motion looks the same from every family, on every rest pose") {
  for (const FigurePose& drawn :
       {FigurePose{}, FigurePose{.right_arm = 90, .right_forearm = 90, .left_arm = 150, .left_forearm = 200},
        FigurePose{.right_arm = 0, .right_forearm = 0, .left_arm = 45, .left_forearm = -40, .leg = 25}}) {
    const Skeleton target = figureSkeleton(drawn);
    const Clip reference = retargeted("cmu", target).clip;
    for (const std::string& family : kFamilies) {
      CAPTURE(family, drawn.left_arm);
      const Clip clip = retargeted(family, target).clip;
      CHECK(clip.duration_s() == Approx(0.8).margin(1e-4));
      for (const float time_s : {0.0f, 0.3f, 0.8f}) {
        auto at = places(clip, target, time_s), expected = places(reference, target, time_s);
        for (const auto& [from, to] : {std::pair("left_shoulder", "left_elbow"),
                                       {"left_elbow", "left_hand"},
                                       {"right_shoulder", "right_elbow"},
                                       {"right_elbow", "right_hand"},
                                       {"left_hip", "left_knee"},
                                       {"left_knee", "left_foot"},
                                       {"right_hip", "right_knee"},
                                       {"pelvis", "neck"}}) {
          CAPTURE(from, to, time_s);
          CHECK((bone(at, from, to) - bone(expected, from, to)).norm() < 0.02);
        }
        CHECK((at["pelvis"] - expected["pelvis"]).norm() < 0.02);
      }
      // The left arm up at its side, the right forearm forwards, the left thigh forwards, a way forwards.
      auto start = places(clip, target, 0), end = places(clip, target, 0.8f);
      CHECK(bone(end, "left_shoulder", "left_elbow").y() == Approx(std::sin(M_PI / 3)).margin(0.02));
      CHECK(bone(end, "left_shoulder", "left_elbow").x() > 0.4);
      CHECK(bone(end, "right_elbow", "right_hand").z() > 0.9);
      CHECK(bone(end, "left_hip", "left_knee").z() == Approx(std::sin(50 * M_PI / 180)).margin(0.02));
      CHECK(end["pelvis"].z() - start["pelvis"].z() == Approx(0.3 * 0.74 / 0.82).margin(0.01));
      CHECK(bone(end, "pelvis", "neck").z() > 0.15);
      // The standing foot stands.
      CHECK(end["right_foot"].y() == Approx(start["right_foot"].y()).margin(0.02));
    }
  }
}

TEST_CASE("rest poses never count: a motion whose bones rest along x curled figures into a ball") {
  for (const std::string& family : kFamilies) {
    const std::string path = kMotions + family + ".bvh";
    const BvhMotion motion = readBvh(path);
    const Skeleton target = figureSkeleton({.right_arm = 60, .left_arm = 150, .leg = 15});
    const FigureShape shape = shapeOfBones(target);
    const Clip expected = retargetMotion(motion, path, target, shape).clip;
    for (int kind = 0; kind < 5; ++kind) {
      CAPTURE(family, kind);
      const BvhMotion odd = withRestPose(motion, oddRestPose(motion.skeleton, kind));
      const Clip clip = retargetMotion(odd, path, target, shape).clip;
      for (float time_s = 0; time_s <= motion.clip.duration_s(); time_s += 0.1f) {
        const Pose a = samplePose(clip, target, time_s), b = samplePose(expected, target, time_s);
        CHECK((a.root_translation - b.root_translation).norm() < 1e-4f);
        for (std::size_t j = 0; j < target.joints.size(); ++j)
          CHECK(a.rotations[j].angularDistance(b.rotations[j]) < 2e-3f);
      }
    }
  }
}

TEST_CASE("a motion of a figure that stands laid one down who leans, as if the file had other axes") {
  BvhMotion motion;
  motion.skeleton = figureSkeleton();
  motion.tips.assign(motion.skeleton.joints.size(), Eigen::Vector3d::Zero());
  for (const Joint& joint : motion.skeleton.joints) {
    JointTrack track;
    track.joint = joint.name;
    track.times_s = {0, 1};
    track.rotations.assign(2, Eigen::Quaternionf::Identity());
    motion.clip.tracks.push_back(track);
  }
  Skeleton leans = figureSkeleton();
  const Eigen::Vector3d root = leans.joints[0].position;
  for (Joint& joint : leans.joints)
    joint.position = root + Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()) * (joint.position - root);
  const auto check = [&](const BvhMotion& given) {
    const Clip clip = retargetMotion(given, "stands.bvh", leans, shapeOfBones(leans)).clip;
    auto at = places(clip, leans, 0);
    CHECK(bone(at, "body", "neck").y() == Approx(std::cos(1)).margin(1e-3));  // as drawn
    CHECK(bone(at, "left_hip", "left_knee").y() < -.8f);
    CHECK(bone(at, "right_hip", "right_knee").y() < -.8f);
  };
  check(motion);

  // But a file of a program whose up is z has other axes.
  const Eigen::Quaterniond lies(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  for (Joint& joint : motion.skeleton.joints) joint.position = lies * joint.position;
  check(motion);
}

TEST_CASE("who turns around goes on facing the viewer where that is asked for") {
  const std::string path = kMotions + "cmu.bvh";
  const BvhMotion straight = readBvh(path);
  BvhMotion turning = straight;
  for (JointTrack& track : turning.clip.tracks)
    if (track.joint == turning.skeleton.joints[0].name)
      for (std::size_t f = 0; f < track.rotations.size(); ++f)
        track.rotations[f] =
            Eigen::Quaternionf(Eigen::AngleAxisf(0.2f * float(f), Vector3f::UnitY())) * track.rotations[f];
  const Skeleton target = figureSkeleton();
  const auto end = [&](const BvhMotion& motion, bool keeps_facing) {
    const Clip clip =
        retargetMotion(motion, path, target, shapeOfBones(target), {.keeps_facing = keeps_facing}).clip;
    return samplePose(clip, target, motion.clip.duration_s());
  };
  const Pose expected = end(straight, true), facing = end(turning, true), turned = end(turning, false);
  for (std::size_t j = 0; j < target.joints.size(); ++j)
    CHECK(facing.rotations[j].angularDistance(expected.rotations[j]) < 2e-3f);
  CHECK(turned.rotations[0].angularDistance(expected.rotations[0]) > 0.5f);
}

TEST_CASE("a joint at its parent's place is no hip: the jumping jack turned its hips about") {
  std::string text = readFile(kMotions + "cmu.bvh");
  for (const auto& [from, to] : {std::pair("LeftUpLeg", "LeftHip"),
                                 {"RightUpLeg", "RightHip"},
                                 {"LeftLeg", "LeftKnee"},
                                 {"RightLeg", "RightKnee"}}) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, std::string(from).size(), to);
  }
  BvhMotion motion = parseBvh(text, "jack.bvh");
  Skeleton& theirs = motion.skeleton;
  for (const char* joint : {"LHipJoint", "RHipJoint"})
    theirs.joints[std::size_t(theirs.index(joint))].position = theirs.joints[0].position;
  const Skeleton target = figureSkeleton();
  for (const auto& [ours, found] :
       retargetMotion(motion, "jack.bvh", target, shapeOfBones(target)).match.joints) {
    if (ours == "left_hip") CHECK(found == "LeftHip");
    if (ours == "right_hip") CHECK(found == "RightHip");
  }
}

TEST_CASE("what is no figure is refused") {
  CHECK_THROWS_WITH(
      retargetMotion(parseBvh(kTiny, "tiny.bvh"), "tiny.bvh", figureSkeleton(), {}),
      "tiny.bvh: has no joints that could be told to be arms and legs, by name or by the shape of "
      "the tree");
}

TEST_CASE("who stands on his hands does a motion of others standing on his feet") {
  const Skeleton upright = figureSkeleton(), skeleton = upsideDown(upright);
  for (const std::string family : {"cmu", "mixamo", "rokoko"}) {
    CAPTURE(family);
    const Clip clip = retargeted(family, skeleton).clip, as_upright = retargeted(family, upright).clip;
    auto at = places(clip, skeleton, 0.5f), expected = places(as_upright, upright, 0.5f);
    CHECK(bone(at, "pelvis", "neck").dot(bone(expected, "pelvis", "neck")) > 0.9f);
    CHECK(bone(at, "left_hip", "left_foot").dot(bone(expected, "left_hip", "left_foot")) > 0.9f);
    CHECK(std::min(at["left_foot"].y(), at["right_foot"].y()) < 0.3f);
  }
}
