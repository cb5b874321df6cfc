#include "libskel/animation/role_figure.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/animation/sample_pose.h"
#include "tests/support/catch.h"
#include "tests/support/elk.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kElkHeight_m = 2.7753f;  // of the mesh, with its antlers
const std::vector<std::string> kHooves = {"front_hoof_l", "front_hoof_r", "hind_hoof_l", "hind_hoof_r"};

const Clip& quadrupedClip(const std::string& name) {
  static const std::vector<Clip> clips = clipsFor(builtinClips(), loadTemplate("quadruped"));
  return clipNamed(clips, name);
}

Clip onElk(const std::string& name, const Skeleton& elk) {
  const std::optional<RoleFigure> figure = roleFigure(elk);
  REQUIRE(figure);
  FigureShape shape = shapeOfBones(figure->skeleton);
  shape.height_m = double(kElkHeight_m);
  return retargetByRoles(quadrupedClip(name), *figure, elk, shape);
}

// Where the bones of the joints end, or the joints without such.
std::vector<Vector3f> tips(const Clip& clip, const Skeleton& skeleton, float time_s) {
  const Pose pose = samplePose(clip, skeleton, time_s);
  std::vector<Quaternionf> globals;
  std::vector<Vector3f> places, result;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const std::size_t parent = std::size_t(std::max(0, joint.parent));
    const Vector3f at = joint.position.cast<float>();
    globals.push_back(joint.parent < 0 ? pose.rotations[j]
                                       : (globals[parent] * pose.rotations[j]).normalized());
    places.push_back(joint.parent < 0
                         ? Vector3f(at + kElkHeight_m * pose.root_translation)
                         : Vector3f(places[parent] +
                                    globals[parent] * (at - skeleton.joints[parent].position.cast<float>())));
    const Vector3f tip = joint.tail ? joint.tail->cast<float>() : at;
    result.push_back(places.back() + globals.back() * (tip - at));
  }
  return result;
}

std::map<std::string, std::string> partsOf(const Skeleton& skeleton, const Skeleton& names) {
  std::map<std::string, std::string> parts;
  for (const RoleJoint& part : findQuadrupedRoles(skeleton).joints)
    parts[part.role] = names.joints[std::size_t(part.joint)].name;
  return parts;
}

}  // namespace

TEST_CASE("the joints of the elk have their parts by their names, and its legs by their shape") {
  const Skeleton& elk = elkSkeleton();
  std::map<std::string, std::string> parts = partsOf(elk, elk);
  CHECK_FALSE(findQuadrupedRoles(elk).by_shape);
  CHECK(parts.size() == 18);
  CHECK(parts["pelvis"] == "pelvis");
  CHECK(parts["neck"] == "neck_1");
  CHECK(parts["head"] == "head");
  CHECK(parts["tail_root"] == "tail_1");
  CHECK(parts["tail"] == "tail_2");
  CHECK(parts["left_shoulder"] == "upper_arm_l");
  CHECK(parts["left_elbow"] == "front_cannon_l");
  CHECK(parts["right_front_foot"] == "front_hoof_r");
  CHECK(parts["right_hip"] == "thigh_r");
  CHECK(parts["left_knee"] == "shin_l");
  CHECK(parts["left_hind_foot"] == "hind_hoof_l");

  Skeleton nameless = elk;
  for (std::size_t j = 0; j < nameless.joints.size(); ++j) nameless.joints[j].name = "b" + std::to_string(j);
  CHECK(findQuadrupedRoles(nameless).by_shape);
  std::map<std::string, std::string> shaped = partsOf(nameless, elk);
  for (const auto& [role, joint] : parts)
    if (role != "head") {
      CAPTURE(role);
      CHECK(shaped[role] == joint);
    }
}

TEST_CASE(
    "the elk's walk lifts every foot in its turn, closes its loop, stays on the ground and keeps its sides") {
  const Skeleton& elk = elkSkeleton();
  const Clip walk = onElk("walk", elk);
  const float duration_s = walk.duration_s();
  for (const std::string& hoof : kHooves) {
    CAPTURE(hoof);
    const std::size_t joint = std::size_t(elk.index(hoof));
    Vector3f low = Vector3f::Constant(1e9f), high = -low;
    for (int k = 0; k <= 60; ++k) {
      const Vector3f at = tips(walk, elk, duration_s * float(k) / 60)[joint];
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    CHECK(high.z() - low.z() > 0.1f * kElkHeight_m);  // along the way that it looks
    CHECK(high.y() - low.y() > 0.005f * kElkHeight_m);
    CHECK(high.x() - low.x() < 0.02f * kElkHeight_m);
    CHECK(low.y() > -0.02f * kElkHeight_m);
  }
  const std::vector<Vector3f> first = tips(walk, elk, 0), last = tips(walk, elk, duration_s);
  for (std::size_t j = 0; j < first.size(); ++j) CHECK((first[j] - last[j]).norm() < 1e-3f * kElkHeight_m);

  // While a foot of the clip stands, its counterpart is in the air.
  const auto higher = [&](float time_s, const std::string& up, const std::string& down) {
    const std::vector<Vector3f> at = tips(walk, elk, time_s);
    CAPTURE(time_s, up);
    CHECK(at[std::size_t(elk.index(up))].y() > at[std::size_t(elk.index(down))].y() + 0.002f * kElkHeight_m);
  };
  higher(0.9f, "hind_hoof_l", "hind_hoof_r");
  higher(0.3f, "hind_hoof_r", "hind_hoof_l");
  higher(1.1f, "front_hoof_l", "front_hoof_r");
  higher(0.5f, "front_hoof_r", "front_hoof_l");
}

TEST_CASE("an elk that looks elsewhere walks there") {
  Skeleton turned = elkSkeleton();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY()));
  for (Joint& joint : turned.joints) {
    joint.position = turn * joint.position;
    if (joint.tail) joint.tail = turn * *joint.tail;
  }
  const Clip walk = onElk("walk", elkSkeleton()), turned_walk = onElk("walk", turned);
  const std::vector<Vector3f> at = tips(walk, elkSkeleton(), 0.4f),
                              turned_at = tips(turned_walk, turned, 0.4f);
  for (std::size_t j = 0; j < at.size(); ++j)
    CHECK((turn.cast<float>() * at[j] - turned_at[j]).norm() < 5e-3f * kElkHeight_m);
}

TEST_CASE("an animal without a tail walks, but wags none") {
  const std::optional<RoleFigure> whole = roleFigure(elkSkeleton());
  REQUIRE(whole);
  for (const char* name : {"idle", "walk", "gallop", "graze", "nod", "wag"})
    CHECK(fits(quadrupedClip(name), *whole));
  RoleFigure docked = *whole;
  for (Joint& joint : docked.skeleton.joints)
    if (joint.name.starts_with("tail")) joint.name = "none_" + joint.name;
  CHECK(fits(quadrupedClip("walk"), docked));
  Clip misspelt = quadrupedClip("walk");
  misspelt.tracks[0].joint = "bodi";
  CHECK_FALSE(fits(misspelt, docked));
  CHECK_FALSE(fits(quadrupedClip("wag"), docked));
}

TEST_CASE("an animal's only joint of the spine is its body, and not its neck as well") {
  Skeleton animal;
  const auto add = [&](const std::string& name, const std::string& parent, const Eigen::Vector3d& at) {
    animal.joints.push_back({name, animal.find(parent), {}, at});
  };
  add("Hips", "", {0, 1, 0});
  add("Spine", "Hips", {-1, 1, 0});
  add("Head", "Spine", {-1.3, 1.5, 0});
  for (const auto& [side, z] : {std::pair(std::string("L_"), .2), {std::string("R_"), -.2}})
    for (const auto& [leg, carrier, x] :
         {std::tuple(std::string("front"), "Spine", -1.), {std::string("hind"), "Hips", 0.}}) {
      add(side + leg + "_upper", carrier, {x, .9, z});
      add(side + leg + "_lower", side + leg + "_upper", {x, .5, z});
      add(side + leg + "_paw", side + leg + "_lower", {x, 0, z});
    }
  auto parts = partsOf(animal, animal);
  CHECK(parts["body"] == "Spine");
  CHECK_FALSE(parts.contains("neck"));
  animal.joints[1].name = "Neck";
  parts = partsOf(animal, animal);
  CHECK(parts["neck"] == "Neck");
  CHECK_FALSE(parts.contains("body"));
}

TEST_CASE("a human skeleton with usual names walks as a biped, whichever way it looks") {
  Skeleton human = figureSkeleton();
  const std::map<std::string, std::string> names = {{"pelvis", "Hips"},
                                                    {"body", "Spine"},
                                                    {"neck", "Neck"},
                                                    {"head", "Head"},
                                                    {"head_top", "HeadTop_End"},
                                                    {"left_shoulder", "LeftArm"},
                                                    {"left_elbow", "LeftForeArm"},
                                                    {"left_hand", "LeftHand"},
                                                    {"right_shoulder", "RightArm"},
                                                    {"right_elbow", "RightForeArm"},
                                                    {"right_hand", "RightHand"},
                                                    {"left_hip", "LeftUpLeg"},
                                                    {"left_knee", "LeftLeg"},
                                                    {"left_foot", "LeftFoot"},
                                                    {"right_hip", "RightUpLeg"},
                                                    {"right_knee", "RightLeg"},
                                                    {"right_foot", "RightFoot"}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY()));
  for (Joint& joint : human.joints) {
    joint.name = "mixamorig:" + names.at(joint.name);
    joint.position = turn * joint.position;
  }
  CHECK(findQuadrupedRoles(human).joints.empty());
  const std::optional<RoleFigure> figure = roleFigure(human);
  REQUIRE(figure);
  CHECK(figure->skeleton.template_name == "biped");
  const std::vector<Clip> clips = clipsFor(builtinClips(), loadTemplate("biped"));
  const Clip& walk = clipNamed(clips, "walk");
  REQUIRE(fits(walk, *figure));
  CHECK_FALSE(fits(quadrupedClip("walk"), *figure));
  const Clip clip = retargetByRoles(walk, *figure, human, shapeOfBones(figure->skeleton));
  const std::size_t foot = std::size_t(human.index("mixamorig:LeftFoot"));
  Vector3f low = Vector3f::Constant(1e9f), high = -low;
  for (int k = 0; k <= 30; ++k) {
    const Vector3f at =
        turn.conjugate().cast<float>() * tips(clip, human, clip.duration_s() * float(k) / 30)[foot];
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  CHECK(high.z() - low.z() > 3 * (high.x() - low.x()));
}

TEST_CASE("the only joint of a spine was taken for the neck, so that clips moved no body") {
  const auto parts = [](const Skeleton& skeleton) {
    const JointRoles roles = findJointRoles(skeleton);
    std::map<std::string, std::string> found;
    for (const char* role : {"pelvis", "body", "neck", "head"})
      if (const int joint = roles.joint(role); joint >= 0)
        found[role] = skeleton.joints[std::size_t(joint)].name;
    return found;
  };
  using Parts = std::map<std::string, std::string>;
  Skeleton human = figureSkeleton();
  const int spine = human.index("body"), neck = human.index("neck");
  human.joints[std::size_t(spine)].name = "Spine";
  CHECK(parts(human) == Parts{{"pelvis", "pelvis"}, {"body", "Spine"}, {"neck", "neck"}, {"head", "head"}});
  for (const char* side : {"left_shoulder", "right_shoulder"})
    human.joints[std::size_t(human.index(side))].parent = spine;
  CHECK(parts(human) == Parts{{"pelvis", "pelvis"}, {"body", "Spine"}, {"neck", "neck"}, {"head", "head"}});
  human.joints[std::size_t(human.index("head"))].parent = spine;
  CHECK(parts(human) == Parts{{"pelvis", "pelvis"}, {"body", "Spine"}, {"head", "head"}});
  REQUIRE(roleFigure(human));
  for (const Clip& clip : clipsFor(builtinClips(), loadTemplate("biped")))
    CHECK(fits(clip, *roleFigure(human)));
  human.joints[std::size_t(neck)].name = "Chest";
  human.joints[std::size_t(spine)].name = "Neck1";
  CHECK(parts(human) == Parts{{"pelvis", "pelvis"}, {"neck", "Neck1"}, {"head", "head"}});
}

TEST_CASE("thousands of ends on one long way of long names are looked at in steps of joints") {
  // Each end read all names above it: minutes for a file of some megabytes.
  constexpr int kChain = 2048, kJoints = 4096;
  Skeleton skeleton;
  for (int j = 0; j < kJoints; ++j) {
    Joint& joint = skeleton.joints.emplace_back();
    joint.name = "left " + std::string(4000, 'f') + std::to_string(j);
    joint.parent = std::min(j, kChain) - 1;
    joint.position = {0, j < kChain ? 1 - j / double(kChain) : 0, 0.001 * j};
  }
  CHECK(findQuadrupedRoles(skeleton).joints.empty());
  CHECK_FALSE(roleFigure(skeleton));
}
