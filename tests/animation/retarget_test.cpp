#include "libskel/animation/retarget.h"

#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "libskel/animation/arm_abilities.h"
#include "libskel/animation/bone_turn.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"
#include "libskel/core/segment.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

using Eigen::Vector3f;

// Positions of the joints at one moment.
std::vector<Vector3f> positions(const Clip& clip, const Skeleton& skeleton, float time_s) {
  const Pose pose = samplePose(clip, skeleton, time_s);
  std::vector<Eigen::Quaternionf> globals;
  std::vector<Vector3f> result;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (joint.parent < 0) {
      globals.push_back(pose.rotations[j]);
      result.push_back(joint.position.cast<float>());
      continue;
    }
    const Vector3f offset = (joint.position - skeleton.joints[joint.parent].position).cast<float>();
    result.push_back(result[joint.parent] + globals[joint.parent] * offset);
    globals.push_back(globals[joint.parent] * pose.rotations[j]);
  }
  return result;
}

Vector3f bone(const std::vector<Vector3f>& at, const Skeleton& skeleton, const char* from, const char* to) {
  return (at[skeleton.index(to)] - at[skeleton.index(from)]).normalized();
}

// Arms down, out, up, up past the vertical, on the hips, across the belly, forearm up.
const FigurePose kDrawnPoses[] = {
    {},
    {.right_arm = 90, .right_forearm = 90, .left_arm = 90, .left_forearm = 90},
    {.right_arm = 170, .right_forearm = 180, .left_arm = 170, .left_forearm = 180},
    {.right_arm = 150, .right_forearm = 215, .left_arm = 150, .left_forearm = 215},
    {.right_arm = 50, .right_forearm = -60, .left_arm = 50, .left_forearm = -60},
    {.right_arm = -10, .right_forearm = -80},
    {.right_arm = 30, .right_forearm = 170},
};

}  // namespace

TEST_CASE(
    "however the arms were drawn, the wave begins and ends in the drawn pose and looks the same between") {
  const Clip& wave = clipNamed(builtinClips(), "wave");
  const Skeleton straight = figureSkeleton({.right_arm = 0, .right_forearm = 0, .leg = 0});
  const Clip reference = retargetToRest(wave, straight);
  for (const FigurePose& pose : kDrawnPoses) {
    const Skeleton skeleton = figureSkeleton(pose);
    CAPTURE(pose.right_arm, pose.right_forearm);
    const Clip clip = retargetToRest(wave, skeleton);
    for (const float time_s : {0.0f, wave.duration_s()})
      for (const Eigen::Quaternionf& rotation : samplePose(clip, skeleton, time_s).rotations)
        CHECK(std::abs(rotation.w()) == Approx(1).margin(1e-5));
    for (float time_s = wave.lead_s; time_s <= wave.duration_s() - wave.lead_s; time_s += 0.1f) {
      const auto at = positions(clip, skeleton, time_s), expected = positions(reference, straight, time_s);
      for (const auto& [from, to] :
           {std::pair("right_shoulder", "right_elbow"), {"right_elbow", "right_hand"}})
        CHECK((bone(at, skeleton, from, to) - bone(expected, straight, from, to)).norm() < 0.02);
      // Legs are not touched.
      for (const char* joint : {"left_knee", "left_foot", "right_foot"})
        CHECK((at[skeleton.index(joint)].cast<double>() - skeleton.joints[skeleton.index(joint)].position)
                  .norm() < 1e-5);
    }
  }
}

TEST_CASE("the waving hand is up beside the head and goes to and fro") {
  const Skeleton skeleton = figureSkeleton();
  const Clip clip = retargetToRest(clipNamed(builtinClips(), "wave"), skeleton);
  double left = 1e9, right = -1e9;
  for (float time_s = 0.7f; time_s <= 2.1f; time_s += 0.05f) {
    const auto at = positions(clip, skeleton, time_s);
    const Vector3f hand = at[skeleton.index("right_hand")];
    CHECK(hand.y() > at[skeleton.index("right_shoulder")].y() + 0.1);
    CHECK(std::abs(hand.z()) < 1e-4);
    left = std::min(left, double(hand.x())), right = std::max(right, double(hand.x()));
  }
  CHECK(right - left > 0.1);
  CHECK(right < -0.15);
}

TEST_CASE("the waving forearm keeps off the head, however large it is") {
  for (const double radius : {0.1, 0.2, 0.3, 0.4})
    for (FigurePose pose : kDrawnPoses) {
      pose.head_radius = radius;
      const Skeleton skeleton = figureSkeleton(pose);
      const Clip& wave = clipNamed(builtinClips(), "wave");
      const Clip clip = retargetToRest(wave, skeleton);
      for (float time_s = wave.lead_s; time_s <= wave.duration_s() - wave.lead_s; time_s += 0.05f) {
        const auto at = positions(clip, skeleton, time_s);
        CAPTURE(radius, pose.right_arm, time_s);
        CHECK(distanceToSegment(at[skeleton.index("head")], at[skeleton.index("right_elbow")],
                                at[skeleton.index("right_hand")]) > radius);
      }
    }
}

TEST_CASE("on the way up the arm never crosses the trunk") {
  for (const FigurePose& pose : kDrawnPoses) {
    const Skeleton skeleton = figureSkeleton(pose);
    const Clip& wave = clipNamed(builtinClips(), "wave");
    const Clip clip = retargetToRest(wave, skeleton);
    const double drawn = skeleton.joints[skeleton.index("right_elbow")].position.x();
    for (float time_s = 0; time_s <= wave.duration_s(); time_s += 0.02f)
      CHECK(positions(clip, skeleton, time_s)[skeleton.index("right_elbow")].x() <
            std::max(drawn, -0.17) + 0.02);
  }
}

TEST_CASE("keys are dense enough that slerp between them is the motion") {
  const Clip& wave = clipNamed(builtinClips(), "wave");
  for (const FigurePose& pose : kDrawnPoses) {
    const Skeleton skeleton = figureSkeleton(pose);
    const Clip clip = retargetToRest(wave, skeleton), fine = retargetToRest(wave, skeleton, {.rate_hz = 480});
    for (float time_s = 0; time_s <= wave.duration_s(); time_s += 0.011f) {
      const auto a = positions(clip, skeleton, time_s), b = positions(fine, skeleton, time_s);
      for (std::size_t j = 0; j < a.size(); ++j) CHECK((a[j] - b[j]).norm() < 0.005);
    }
  }
}

TEST_CASE("a clip that is retargeted already stays as it is") {
  const Skeleton skeleton = figureSkeleton(kDrawnPoses[2]);
  RetargetOptions all_keys;
  all_keys.thin_keys = false;
  const Clip once = retargetToRest(clipNamed(builtinClips(), "wave"), skeleton, all_keys),
             twice = retargetToRest(once, skeleton, all_keys);
  for (std::size_t t = 0; t < once.tracks.size(); ++t)
    for (std::size_t k = 0; k < once.tracks[t].rotations.size(); ++k)
      CHECK(once.tracks[t].rotations[k].isApprox(twice.tracks[t].rotations[k], 1e-4f));
}

TEST_CASE("bones out of the picture's plane are met as well, and coincident joints do no harm") {
  Skeleton skeleton = figureSkeleton({.right_arm = 60});
  skeleton.joints[skeleton.index("right_hand")].position.z() = 0.2;
  const Clip clip = retargetToRest(clipNamed(builtinClips(), "wave"), skeleton, {.clear_of_head = false});
  const Skeleton straight = figureSkeleton({.right_arm = 0, .right_forearm = 0});
  const Clip expected = retargetToRest(clipNamed(builtinClips(), "wave"), straight, {.clear_of_head = false});
  CHECK((bone(positions(clip, skeleton, 1.3f), skeleton, "right_elbow", "right_hand") -
         bone(positions(expected, straight, 1.3f), straight, "right_elbow", "right_hand"))
            .norm() < 0.02);

  for (Joint& joint : skeleton.joints) joint.position.setZero();
  for (const JointTrack& track : retargetToRest(clipNamed(builtinClips(), "wave"), skeleton).tracks)
    for (const Eigen::Quaternionf& rotation : track.rotations) CHECK(rotation.norm() == Approx(1));
}

TEST_CASE("turns are taken the asked way round, also to the opposite direction") {
  constexpr double kPi = std::numbers::pi;
  const Eigen::Vector3d down(0, -1, 0), up(0, 1, 0);
  CHECK(boneTurn(down, up, 1).angle_rad == Approx(kPi));
  CHECK(boneTurn(down, up, -1).angle_rad == Approx(-kPi));
  CHECK((boneTurn(down, up, -1).share(1) * down - up).norm() < 1e-9);
  CHECK(boneTurn(down, up, -1).share(0).isApprox(Eigen::Quaterniond::Identity()));
  const Eigen::Vector3d slanted = Eigen::Vector3d(0.3, 0.5, 0.4).normalized();
  CHECK((boneTurn(down, slanted, 1).share(1) * down - slanted).norm() < 1e-9);
}

TEST_CASE("a clip that puts the pelvis, the body, a hip or an unknown joint on the ground is refused") {
  const Skeleton skeleton = figureSkeleton();
  Clip clip = clipNamed(builtinClips(), "walk");
  for (const std::string joint : {"pelvis", "body", "left_hip"}) {
    clip.contacts = {{joint, 0, .5f}};
    CHECK_THROWS_WITH(
        retargetToRest(clip, skeleton),
        "the clip \"walk\" puts \"" + joint + "\" on the ground, which ends no limb of two bones");
  }
  clip.contacts = {{"tail", 0, .5f}};
  CHECK_THROWS_WITH(retargetToRest(clip, skeleton),
                    "the clip \"walk\" puts \"tail\" on the ground, which this skeleton lacks");
  CHECK_FALSE(fits(clip, skeleton));
  clip.contacts = {{"left_foot", 0, .5f}};
  CHECK(fits(clip, skeleton));
  CHECK_NOTHROW(retargetToRest(clip, skeleton));
}

TEST_CASE("a clip, a skeleton or a rate that is none is refused, not an abort") {
  Clip clip = clipNamed(builtinClips(), "wave");
  const Skeleton skeleton = figureSkeleton();
  for (const float rate_hz :
       {std::numeric_limits<float>::quiet_NaN(), 0.f, -30.f, std::numeric_limits<float>::infinity()})
    CHECK_THROWS_AS(retargetToRest(clip, skeleton, {.rate_hz = rate_hz}), UsageError);
  CHECK_THROWS_WITH(retargetToRest(clip, skeleton, {.rate_hz = 1e9f}),
                    Catch::Matchers::Contains("is too long"));
  CHECK_THROWS_AS(retargetToRest(clip, Skeleton()), UsageError);
  Skeleton ring = skeleton;
  ring.joints[3].parent = 12;
  CHECK_THROWS_AS(retargetToRest(clip, ring), UsageError);
  clip.tracks[1].rotations.pop_back();
  CHECK_THROWS_WITH(retargetToRest(clip, skeleton),
                    Catch::Matchers::Contains("the clip \"wave\": tracks[1].rotations has"));
  clip = clipNamed(builtinClips(), "wave");
  clip.tracks[0].times_s.back() = 1e9f;
  CHECK_THROWS_WITH(retargetToRest(clip, skeleton),
                    "the clip \"wave\" lasts more than an hour; cut it into parts");
}

TEST_CASE("a clip of too many poses is refused before they are made") {
  Clip clip = clipNamed(builtinClips(), "wave");
  clip.least_duration_s = 3600;
  CHECK_THROWS_WITH(retargetToRest(clip, figureSkeleton(), {.rate_hz = 60}),
                    "the clip \"wave\" is too long: 216001 poses of 17 joints; cut it into parts");
}

namespace {

// The mean height of the pelvis in idle, in that of the rest pose.
double idlePelvis(const Skeleton& skeleton, const FigureShape& shape) {
  RetargetOptions options;
  options.shape = shape;
  const Clip clip = retargetToRest(clipNamed(builtinClips(), "idle"), skeleton, options);
  double sum = 0;
  for (int k = 0; k < 20; ++k)
    sum += shape.height_m *
           double(samplePose(clip, skeleton, clip.duration_s() * float(k) / 20).root_translation.y());
  return 1 + sum / 20 / skeleton.joints[0].position.y();
}

FigureShape withFeet(const Skeleton& skeleton) {
  FigureShape shape = shapeOfBones(skeleton);
  shape.joined.assign(skeleton.joints.size(), 0);
  shape.feet_m.resize(skeleton.joints.size());
  for (const char* foot : {"left_foot", "right_foot"})
    shape.feet_m[std::size_t(skeleton.index(foot))] = {{-0.03, -0.03, 0}, {0.06, -0.03, 0}, {0, 0.03, 0}};
  return shape;
}

}  // namespace

TEST_CASE("the pelvis stays where it was drawn: no leg that is raised, folded or short pulls it down") {
  const Skeleton drawn = figureSkeleton();
  CHECK(idlePelvis(drawn, withFeet(drawn)) == Approx(1).margin(0.03));

  // All that lies below the feet (a cape, a shadow) is no ground.
  Skeleton floating = drawn;
  for (Joint& joint : floating.joints) joint.position.y() += 0.4;
  CHECK(idlePelvis(floating, withFeet(floating)) == Approx(1).margin(0.03));

  const auto withLeg = [&](double knee_x, double knee_y, double foot_x, double foot_y) {
    Skeleton skeleton = drawn;
    const Eigen::Vector3d hip = skeleton.joints[std::size_t(skeleton.index("left_hip"))].position;
    skeleton.joints[std::size_t(skeleton.index("left_knee"))].position =
        hip + Eigen::Vector3d(knee_x, knee_y, 0);
    skeleton.joints[std::size_t(skeleton.index("left_foot"))].position =
        hip + Eigen::Vector3d(foot_x, foot_y, 0);
    return skeleton;
  };
  const Skeleton raised = withLeg(0.38, 0, 0.74, 0.05), folded = withLeg(0.3, -0.23, 0.05, 0.03),
                 stub = withLeg(0, -0.15, 0, -0.3);
  for (const Skeleton& skeleton : {raised, folded, stub}) {
    const double height = idlePelvis(skeleton, withFeet(skeleton));
    CHECK(height > 0.95);
    CHECK(height < 1.05);
  }
  // The raised leg is put down.
  RetargetOptions options;
  options.shape = withFeet(raised);
  const Clip idle = retargetToRest(clipNamed(builtinClips(), "idle"), raised, options);
  const auto at = positions(idle, raised, 1);
  CHECK(bone(at, raised, "left_hip", "left_foot").y() < -0.8f);
}

TEST_CASE("who stands on his hands stands up on his feet, to idle and talk as well") {
  const Skeleton upright = figureSkeleton();
  const auto halfWay = [&](const char* name, const Skeleton& skeleton) {
    RetargetOptions options;
    options.shape = withFeet(skeleton);
    const Clip clip = retargetToRest(clipNamed(builtinClips(), name), skeleton, options);
    return positions(clip, skeleton, 0.5f * clip.duration_s());
  };
  for (const char* name : {"idle", "talk", "walk"}) {
    CAPTURE(name);
    const std::vector<Vector3f> at = halfWay(name, upsideDown(upright)), expected = halfWay(name, upright);
    for (const char* joint : {"pelvis", "neck", "head", "left_foot", "right_foot"}) {
      CAPTURE(joint);
      CHECK(at[std::size_t(upright.index(joint))].y() ==
            Approx(expected[std::size_t(upright.index(joint))].y()).margin(0.05));
    }
  }
}

TEST_CASE("who lies, or is bent over, stands up to walk, and who leans a little goes on leaning") {
  const auto turned = [](double degrees) {
    Skeleton skeleton = figureSkeleton();
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    double low = 1e9;
    for (Joint& joint : skeleton.joints) {
      joint.position.head<2>() = turn * joint.position.head<2>().eval();
      low = std::min(low, joint.position.y());
    }
    for (Joint& joint : skeleton.joints) joint.position.y() -= low;
    return skeleton;
  };
  struct Walk {
    double lean_deg, foot_m;  // in the mean; the lower foot's joint above the ground
  };
  const auto walk = [](const Skeleton& skeleton) {
    RetargetOptions options;
    options.shape = withFeet(skeleton);
    const Clip clip = retargetToRest(clipNamed(builtinClips(), "walk"), skeleton, options);
    Walk mean{0, 0};
    constexpr int kMoments = 8;
    for (int k = 0; k < kMoments; ++k) {
      const float time_s = clip.duration_s() * float(k) / kMoments;
      const auto at = positions(clip, skeleton, time_s);
      const Vector3f trunk = bone(at, skeleton, "pelvis", "neck");
      mean.lean_deg += std::atan2(-double(trunk.x()), double(trunk.y())) * 180 / std::numbers::pi / kMoments;
      const double up =
          options.shape->height_m * double(samplePose(clip, skeleton, time_s).root_translation.y());
      const auto foot = [&](const char* name) {
        return double(at[std::size_t(skeleton.index(name))].y()) + up;
      };
      mean.foot_m += std::min(foot("left_foot"), foot("right_foot")) / kMoments;
    }
    return mean;
  };
  const double standing_m = walk(turned(0)).foot_m;
  for (const double degrees : {88., -88., 150.}) {
    CAPTURE(degrees);
    const Walk lying = walk(turned(degrees));
    CHECK(std::abs(lying.lean_deg) < 5);
    CHECK(lying.foot_m == Approx(standing_m).margin(0.07));  // its sole was drawn upright
  }
  for (const double degrees : {20., -20.}) CHECK(walk(turned(degrees)).lean_deg == Approx(degrees).margin(3));
  // In between the less of the lean is left the farther it goes.
  CHECK(std::abs(walk(turned(60)).lean_deg) < 15);

  // One who is folded at the hips stays folded.
  Skeleton folded = turned(0);
  const Eigen::Vector3d pelvis = folded.joints[0].position;
  for (Joint& joint : folded.joints)
    if (joint.position.y() > pelvis.y()) {
      const Eigen::Vector3d from = joint.position - pelvis;
      joint.position = pelvis + Eigen::Vector3d(from.y() * .8, from.x() - .6 * from.y(), 0);
    }
  CHECK(walk(folded).lean_deg < -90);

  // A head bowed on an upright trunk stays bowed.
  Skeleton bowed = figureSkeleton();
  bowed.joints[std::size_t(bowed.index("head_top"))].position =
      bowed.joints[std::size_t(bowed.index("head"))].position + Eigen::Vector3d(0.2, -0.1, 0);
  const auto at = positions(retargetToRest(clipNamed(builtinClips(), "walk"), bowed), bowed, 0);
  CHECK(bone(at, bowed, "head", "head_top").y() < 0);
}

TEST_CASE(
    "a wave by an arm that is grown to the body, or leaves its hand, is the other arm's, or the trunk's") {
  const Skeleton skeleton = figureSkeleton();
  const Clip& wave = clipNamed(builtinClips(), "wave");
  RetargetOptions options;
  options.shape = withFeet(skeleton);
  const auto hand = [&](const std::string& side) {
    const auto at = positions(retargetToRest(wave, skeleton, options), skeleton, 1.2f);
    return double(at[std::size_t(skeleton.index(side + "hand"))].y() -
                  at[std::size_t(skeleton.index(side + "shoulder"))].y());
  };
  const auto elbow = [&](const char* side) {
    return std::size_t(skeleton.index(std::string(side) + "_elbow"));
  };
  // How far the head goes to each side of where it was drawn, m.
  const auto rocked = [&] {
    const Clip clip = retargetToRest(wave, skeleton, options);
    const std::size_t head = std::size_t(skeleton.index("head"));
    double left = 0, right = 0;
    for (float time_s = 0; time_s < clip.duration_s(); time_s += 0.05f) {
      const double x =
          double(positions(clip, skeleton, time_s)[head].x()) - skeleton.joints[head].position.x();
      left = std::max(left, -x), right = std::max(right, x);
    }
    return std::min(left, right);
  };
  CHECK(hand("right_") > 0.1);
  CHECK(hand("left_") < 0);
  CHECK(rocked() < 0.05);
  options.shape->joined[elbow("right")] = 1;
  CHECK(hand("right_") < 0);
  CHECK(hand("left_") > 0.1);
  options.shape->joined[elbow("left")] = 1;
  CHECK(hand("right_") < 0);
  CHECK(hand("left_") < 0);
  CHECK(rocked() > 0.1);

  options.shape->joined.assign(skeleton.joints.size(), 0);
  options.shape->taken.assign(skeleton.joints.size(), 1);
  CHECK(hand("right_") > 0.1);
  options.shape->taken[elbow("right")] = 0.4;
  CHECK(hand("right_") < 0);
  CHECK(hand("left_") > 0.1);
  options.shape->taken[elbow("left")] = 0.4;
  CHECK(hand("left_") < 0);
  CHECK(rocked() > 0.1);

  // A trunk that bows already bows no deeper.
  const auto bow = [&](const FigureShape& shape) {
    RetargetOptions as_shaped;
    as_shaped.shape = shape;
    const Clip greet = retargetToRest(clipNamed(builtinClips(), "greet"), skeleton, as_shaped);
    return samplePose(greet, skeleton, 1.2f).rotations[std::size_t(skeleton.index("body"))];
  };
  CHECK(bow(*options.shape).angularDistance(bow(withFeet(skeleton))) < 0.05f);
}

TEST_CASE("who can move neither arm talks with the trunk, and neither breathes nor walks the more") {
  const Skeleton skeleton = figureSkeleton();
  RetargetOptions options;
  options.shape = withFeet(skeleton);
  // How far the joint turns from how it was drawn, at most, rad.
  const auto farthest = [&](const char* clip, const char* joint) {
    const Clip retargeted = retargetToRest(clipNamed(builtinClips(), clip), skeleton, options);
    float most = 0;
    for (float time_s = 0; time_s < retargeted.duration_s(); time_s += 0.05f)
      most = std::max(most, samplePose(retargeted, skeleton, time_s)
                                .rotations[std::size_t(skeleton.index(joint))]
                                .angularDistance(Eigen::Quaternionf::Identity()));
    return most;
  };
  const auto grow = [&](const char* side) {
    options.shape->joined[std::size_t(skeleton.index(std::string(side) + "_elbow"))] = 1;
  };
  const char* clips[] = {"talk", "greet", "idle", "walk"};
  std::map<std::string, float> free, one, none;
  for (const char* clip : clips) free[clip] = farthest(clip, "body");
  grow("right");
  for (const char* clip : clips) one[clip] = farthest(clip, "body");
  grow("left");
  for (const char* clip : clips) none[clip] = farthest(clip, "body");
  CHECK(none["talk"] > 1.4f * free["talk"]);
  CHECK(one["talk"] == Approx(free["talk"]).margin(0.01));
  for (const char* clip : {"greet", "idle", "walk"}) {
    CAPTURE(clip);
    CHECK(none[clip] == Approx(free[clip]).margin(0.01));
  }
}

TEST_CASE("limbs that point at the viewer turn into the picture aslant, as far as asked for") {
  const Skeleton skeleton = figureSkeleton();
  RetargetOptions options;
  options.shape = withFeet(skeleton);
  options.aslant = true;
  const auto swing = [&](double looks, double share) {
    options.shape->looks = looks;
    options.into_picture = share;
    const Clip walk = retargetToRest(clipNamed(builtinClips(), "walk"), skeleton, options);
    Vector3f low = Vector3f::Constant(1e9f), high = -low;
    for (int k = 0; k < 20; ++k) {
      const auto at = positions(walk, skeleton, walk.duration_s() * float(k) / 20);
      const Vector3f leg = bone(at, skeleton, "left_hip", "left_foot");
      low = low.cwiseMin(leg), high = high.cwiseMax(leg);
    }
    return Vector3f(high - low);
  };
  const Vector3f ahead = swing(1, 0), half = swing(1, 0.5), flat = swing(1, 1), model = swing(0, 1);
  CHECK(ahead.z() > 5 * ahead.x());
  CHECK(flat.x() > 5 * flat.z());
  CHECK(half.x() > 2 * ahead.x());
  CHECK(half.z() < 0.8f * ahead.z());
  CHECK(model.isApprox(ahead));
}

TEST_CASE("arms that move in the picture stay where they are while legs turn aside") {
  const Skeleton skeleton = figureSkeleton();
  Clip clip = clipNamed(builtinClips(), "walk");
  for (JointTrack& track : clip.tracks)
    for (Eigen::Quaternionf& rotation : track.rotations)
      if (track.joint.ends_with("shoulder")) {
        const float out = track.joint.starts_with("left") ? 1.f : -1.f;
        rotation = Eigen::Quaternionf(Eigen::AngleAxisf(out * 1.2f, Vector3f::UnitZ())) *
                   Eigen::Quaternionf(Eigen::AngleAxisf(0.3f, Vector3f::UnitX()));
      } else if (track.joint.ends_with("elbow")) {
        rotation.setIdentity();
      }
  RetargetOptions options;
  options.shape = withFeet(skeleton);
  options.shape->looks = 1;
  options.aslant = true;
  const auto moved = [&](const char* from, const char* to) {
    double most = 0;
    options.into_picture = 0;
    const Clip in_space = retargetToRest(clip, skeleton, options);
    options.into_picture = 1;
    const Clip aside = retargetToRest(clip, skeleton, options);
    for (float t : {0.2f, 0.4f, 0.6f, 0.8f}) {
      const auto a = positions(in_space, skeleton, t * clip.duration_s()),
                 b = positions(aside, skeleton, t * clip.duration_s());
      most = std::max(most, double((bone(a, skeleton, from, to) - bone(b, skeleton, from, to)).norm()));
    }
    return most;
  };
  CHECK(moved("left_shoulder", "left_elbow") < 0.01);
  CHECK(moved("right_shoulder", "right_elbow") < 0.01);
  CHECK(moved("left_hip", "left_knee") > 0.1);
}

namespace {

// Where the feet are while the figure walks, seen from the front.
struct Steps {
  double nearest_m = 1e9;                    // of the left foot to the right of the right one
  double left_lift_m = 0, right_lift_m = 0;  // of the foot over where it stands
  double both_lift_m = 0;                    // of the lower foot
  double knees_m = 0;                        // how far knees go outwards beyond the hips
  double left_lean = 0, right_lean = 0;      // of the trunk, to each side
};

Steps stepsOf(const Skeleton& skeleton, const FigureShape& shape, bool aslant) {
  RetargetOptions options;
  options.shape = shape;
  options.aslant = aslant;
  const Clip walk = retargetToRest(clipNamed(builtinClips(), "walk"), skeleton, options);
  const auto joint = [&](const char* name) { return std::size_t(skeleton.index(name)); };
  std::vector<std::vector<Vector3f>> poses;
  double ground = 1e9;
  for (int k = 0; k < 40; ++k) {
    poses.push_back(positions(walk, skeleton, walk.duration_s() * float(k) / 40));
    // positions() leaves the root where it rests.
    const Pose pose = samplePose(walk, skeleton, walk.duration_s() * float(k) / 40);
    for (Vector3f& at : poses.back()) at += float(shape.height_m) * pose.root_translation;
    for (const char* foot : {"left_foot", "right_foot"})
      ground = std::min(ground, double(poses.back()[joint(foot)].y()));
  }
  Steps steps;
  for (const auto& at : poses) {
    const Vector3f left = at[joint("left_foot")], right = at[joint("right_foot")];
    const double l = double(left.y()) - ground, r = double(right.y()) - ground;
    steps.nearest_m = std::min(steps.nearest_m, double(left.x() - right.x()));
    steps.left_lift_m = std::max(steps.left_lift_m, l);
    steps.right_lift_m = std::max(steps.right_lift_m, r);
    steps.both_lift_m = std::max(steps.both_lift_m, std::min(l, r));
    steps.knees_m = std::max({steps.knees_m, double(at[joint("left_knee")].x() - at[joint("left_hip")].x()),
                              double(at[joint("right_hip")].x() - at[joint("right_knee")].x())});
    const double lean = double(bone(at, skeleton, "body", "neck").x());
    steps.left_lean = std::max(steps.left_lean, lean);
    steps.right_lean = std::max(steps.right_lean, -lean);
  }
  return steps;
}

}  // namespace

TEST_CASE("one drawn from the front comes towards the viewer: feet lift in turn, and legs do not cross") {
  const Skeleton skeleton = figureSkeleton();
  FigureShape shape = withFeet(skeleton);
  shape.looks = 1;
  const Steps towards = stepsOf(skeleton, shape, false), sideways = stepsOf(skeleton, shape, true);
  CHECK(towards.nearest_m > 0.3);
  CHECK(sideways.nearest_m < 0.2);
  CHECK(towards.left_lift_m > 0.1 * shape.height_m);
  CHECK(towards.right_lift_m > 0.1 * shape.height_m);
  CHECK(towards.both_lift_m < 0.01 * shape.height_m);
  CHECK(towards.knees_m > 0.08);
}

TEST_CASE("who has short legs lifts them as far as they go, rocks from foot to foot and squats less deep") {
  FigureShape shape = withFeet(figureSkeleton());
  shape.looks = 1;
  const auto shortened = [](double share) {
    Skeleton skeleton = figureSkeleton();
    const double lower = (1 - share) * 0.74;
    for (Joint& joint : skeleton.joints) {
      if (joint.name.ends_with("knee")) joint.position.y() += lower / 2;
      if (joint.name.ends_with("foot")) joint.position.y() += lower;
    }
    return skeleton;
  };
  const Steps tall = stepsOf(figureSkeleton(), shape, false), small = stepsOf(shortened(0.4), shape, false);
  CHECK(small.left_lift_m > 0.07 * shape.height_m);
  CHECK(small.right_lift_m > 0.07 * shape.height_m);
  CHECK(small.nearest_m > 0.1);
  CHECK(small.left_lean > 1.5 * tall.left_lean);
  CHECK(small.right_lean > 1.5 * tall.right_lean);

  const auto deepest = [&](double joined) {
    RetargetOptions options;
    options.shape = shape;
    for (const char* foot : {"left_foot", "right_foot"})
      options.shape->joined[std::size_t(figureSkeleton().index(foot))] = joined;
    const Clip jump = retargetToRest(clipNamed(builtinClips(), "jump"), figureSkeleton(), options);
    float least = 0;
    for (const Vector3f& at : jump.root_translations) least = std::min(least, at.y());
    return least;
  };
  CHECK(deepest(0) < -0.12f);
  CHECK(deepest(0.55) > 0.85f * deepest(0));
  CHECK(deepest(0.55) < 0.4f * deepest(0));
}

// Each looked at all joints above it, and at all children of these.
TEST_CASE("thousands of joints at one place point where the bone above them does") {
  Skeleton chain;
  for (int j = 0; j < 4000; ++j)
    chain.joints.push_back({"j" + std::to_string(j), j - 1, {}, {j == 0 ? 0. : 1., 0, 0}});
  const std::vector<Eigen::Vector3d> bones = restBones(chain);
  REQUIRE(bones.size() == 4000);
  CHECK(std::all_of(bones.begin(), bones.end(),
                    [](const Eigen::Vector3d& bone) { return bone == Eigen::Vector3d::UnitX(); }));
}

TEST_CASE(
    "which arm does not follow a clip is said where it is one piece with the body, or leaves its hand "
    "behind") {
  const Skeleton skeleton = figureSkeleton();
  const Clip &walk = clipNamed(builtinClips(), "walk"), &wave = clipNamed(builtinClips(), "wave");
  FigureShape shape = shapeOfBones(skeleton);
  shape.joined.assign(skeleton.joints.size(), 0);
  shape.taken.assign(skeleton.joints.size(), 1);
  const auto staying = [&](const Clip& clip) { return armsThatStay({&clip, 1}, skeleton, shape); };
  CHECK(staying(walk).empty());
  CHECK(staying(wave).empty());
  for (const char* joint : {"left_shoulder", "left_elbow", "left_hand"})
    shape.joined[skeleton.index(joint)] = 1;
  CHECK(staying(walk) ==
        std::vector<std::string>{"the left arm is one piece with the body and does not follow \"walk\""});
  // One that is not all one piece with it moves by more than a third.
  shape.joined[skeleton.index("left_elbow")] = kGrownArm - 0.07F;
  CHECK(staying(walk) == std::vector<std::string>{
                             "the left arm is one piece with the body and follows \"walk\" only in part"});
  shape.joined[skeleton.index("left_elbow")] = 1;
  // One whose bones must turn takes the flesh along that hangs on them, if there is any.
  Clip swing = walk;
  for (JointTrack& track : swing.tracks) track.slack_rad = 0;
  CHECK(staying(swing).empty());
  shape.taken[skeleton.index("left_elbow")] = 0.3;
  CHECK(staying(swing).size() == 1);
  shape.taken[skeleton.index("left_elbow")] = 1;
  Clip left = wave;
  for (JointTrack& track : left.tracks)
    for (const char* part : {"shoulder", "elbow", "hand"})
      if (track.joint == std::string("right_") + part)
        track.joint = std::string("left_") + part;
      else if (track.joint == std::string("left_") + part)
        track.joint = std::string("right_") + part;
  const auto said = staying(left), other = staying(wave);
  const std::string cannot = "the left arm cannot be moved well and does not do \"wave\"; the right arm does";
  CHECK(std::count(said.begin(), said.end(), cannot) + std::count(other.begin(), other.end(), cannot) == 1);
}
