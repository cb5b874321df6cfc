// What hangs on a figure moves a little behind it.
#include "libskel/animation/follow_through.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/animation/retarget.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/skeleton/hanging.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// A figure with a chain of two joints that hangs down from the pelvis.
Skeleton withSkirt() {
  Skeleton skeleton = figureSkeleton();
  const Vector3d pelvis = skeleton.joints[0].position;
  for (int link = 1; link <= 2; ++link) {
    Joint joint;
    joint.name = hangingJointName("skirt", link);
    joint.parent = link == 1 ? 0 : int(skeleton.joints.size()) - 1;
    joint.position = pelvis - Vector3d(0, link == 1 ? 0 : 0.3, 0);
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

// `seconds` of 30 moments each.
std::vector<ModelPose> moved(const Skeleton& skeleton, double seconds,
                             const std::function<void(double, ModelPose&)>& motion) {
  std::vector<ModelPose> poses;
  for (int k = 0; k <= int(30 * seconds); ++k) {
    ModelPose& pose = poses.emplace_back();
    pose.time_s = float(k) / 30;
    pose.globals.assign(skeleton.joints.size(), Quaterniond::Identity());
    motion(k / 30., pose);
  }
  followThrough(skeleton, {}, poses);
  return poses;
}

// Where the chain's last bone points: 0 straight down, above 0 to the right of the picture.
double swungRight(const Skeleton& skeleton, const ModelPose& pose) {
  const Vector3d bone = pose.globals[std::size_t(skeleton.index("hanging_skirt_2"))] * -Vector3d::UnitY();
  return std::atan2(bone.x(), -bone.y());
}

}  // namespace

TEST_CASE("what hangs lags behind one who sets off, swings through when he stops, and comes to rest") {
  const Skeleton skeleton = withSkirt();
  // To the right from .5 s to 1 s, evenly but for a tenth of a second at both ends.
  const std::vector<ModelPose> poses = moved(skeleton, 6, [](double time_s, ModelPose& pose) {
    const double t = std::clamp((time_s - 0.5) / 0.5, 0.0, 1.0);
    pose.root_offset_m = {0.5 * t * t * (3 - 2 * t), 0, 0};
  });
  double lag = 0, through = 0, most = 0;
  for (const ModelPose& pose : poses) {
    const double swung = swungRight(skeleton, pose);
    if (pose.time_s < 0.45f) CHECK(std::abs(swung) < 1e-6);
    if (pose.time_s > 0.5f && pose.time_s < 0.8f) lag = std::min(lag, swung);
    if (pose.time_s > 0.8f) through = std::max(through, swung);
    most = std::max(most, std::abs(swung));
  }
  CHECK(lag < -0.1);
  CHECK(through > 0.1);
  CHECK(most < 2 * kMostHanging_rad);
  CHECK(std::abs(swungRight(skeleton, poses.back())) < 0.01);
}

TEST_CASE(
    "what hangs down keeps to the vertical where the body leans, and nothing else of the body is turned") {
  const Skeleton skeleton = withSkirt();
  const Quaterniond lean(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()));
  const std::vector<ModelPose> poses =
      moved(skeleton, 3, [&](double, ModelPose& pose) { pose.globals.assign(pose.globals.size(), lean); });
  CHECK(swungRight(skeleton, poses.back()) > 0.02);
  CHECK(swungRight(skeleton, poses.back()) < 0.3);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (!hangs(skeleton.joints[j])) CHECK(poses.back().globals[j].angularDistance(lean) < 1e-12);
}

TEST_CASE("clips of one who wears a skirt close where they did, and begin at rest where they did") {
  const Skeleton skeleton = withSkirt(), bare = figureSkeleton();
  const std::size_t hem = std::size_t(skeleton.index("hanging_skirt_2"));
  for (const Clip& made : builtinClips()) {
    if (made.template_name != "biped") continue;
    CAPTURE(made.name);
    const Clip clip = retargetToRest(made, skeleton), without = retargetToRest(made, bare);
    const auto at = [&](float time_s) { return samplePose(clip, skeleton, time_s).rotations[hem]; };
    CHECK(at(0).angularDistance(at(clip.duration_s())) < 0.01f);
    if (made.lead_s > 0) CHECK(at(0).angularDistance(Eigen::Quaternionf::Identity()) < 1e-4f);
    float most = 0;
    for (int k = 0; k < 40; ++k)
      most = std::max(most, at(clip.duration_s() * float(k) / 40).angularDistance(at(0)));
    if (made.name == "dance" || made.name == "run") CHECK(most > 0.05f);
    // All else moves as without it.
    for (int k = 0; k < 5; ++k) {
      const float time_s = clip.duration_s() * float(k) / 5;
      const Pose a = samplePose(clip, skeleton, time_s), b = samplePose(without, bare, time_s);
      for (std::size_t j = 0; j < bare.joints.size(); ++j)
        CHECK(a.rotations[j].angularDistance(b.rotations[j]) < 0.03f);  // keys are thinned by all joints
    }
  }
}

TEST_CASE("a clip that turns what hangs has its way") {
  const Skeleton skeleton = withSkirt();
  Clip run = clipNamed(builtinClips(), "run");
  JointTrack still;
  still.joint = hangingJointName("skirt", 2);
  still.times_s = {0};
  still.rotations = {Eigen::Quaternionf::Identity()};
  run.tracks.push_back(still);
  const Clip clip = retargetToRest(run, skeleton);
  float upper = 0, lower = 0;
  for (int k = 0; k < 20; ++k) {
    const Pose pose = samplePose(clip, skeleton, clip.duration_s() * float(k) / 20);
    const auto turn = [&](const char* joint) {
      return pose.rotations[std::size_t(skeleton.index(joint))].angularDistance(
          Eigen::Quaternionf::Identity());
    };
    upper = std::max(upper, turn("hanging_skirt_1")), lower = std::max(lower, turn("hanging_skirt_2"));
  }
  CHECK(upper > 0.05f);
  CHECK(lower < 1e-3f);
}

TEST_CASE("a clip that was made where something hangs turned all of a figure without it otherwise") {
  const Skeleton with = withSkirt(), bare = figureSkeleton();
  Clip made = retargetToRest(clipNamed(builtinClips(), "walk"), with);
  made.rest_pose = restPoseHash(with);
  REQUIRE(std::any_of(made.tracks.begin(), made.tracks.end(),
                      [](const JointTrack& track) { return isHangingName(track.joint); }));
  Clip without = made;
  std::erase_if(without.tracks, [](const JointTrack& track) { return isHangingName(track.joint); });
  CHECK(fits(made, bare));
  const Clip a = retargetToRest(made, bare), b = retargetToRest(without, bare);
  CHECK(a.tracks.size() == b.tracks.size());
  for (int k = 0; k < 10; ++k) {
    const Pose one = samplePose(a, bare, a.duration_s() * float(k) / 10),
               other = samplePose(b, bare, a.duration_s() * float(k) / 10);
    for (std::size_t j = 0; j < bare.joints.size(); ++j)
      CHECK(one.rotations[j].angularDistance(other.rotations[j]) < 1e-3f);
  }
}
