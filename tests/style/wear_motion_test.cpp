#include "libskel/style/wear_motion.h"

#include "libskel/animation/sample_pose.h"
#include "libskel/style/motion_clip.h"
#include "tests/style/walker.h"
#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("a motion on another body keeps its directions and the body's lengths") {
  const PoseMatrix motion = walker({.lean_rad = 0.2});
  const PoseMatrix rest = walker({.frames = 1, .legs_rad = 0, .arms_rad = 0, .size_px = 500});
  const PoseMatrix worn = wornBy(rest, motion, biped());
  const PoseMatrix wanted = boneDirections(motion, biped()), now = boneDirections(worn, biped());
  for (const std::string joint : {"body", "head", "left_elbow", "right_hand", "left_knee", "right_foot"}) {
    const int j = 2 * biped().find(joint);
    CHECK((wanted - now).middleRows(j, 2).cwiseAbs().maxCoeff() < 1e-9);
  }
  CHECK((boneLengths(worn, biped()) - boneLengths(rest, biped())).cwiseAbs().maxCoeff() < 1e-6);
  // The lower foot comes down to where the drawing stands, and no further.
  double lowest = 0;
  for (const char* foot : {"left_foot", "right_foot"})
    lowest = std::max(lowest, worn.row(2 * biped().find(foot) + 1).maxCoeff());
  CHECK(lowest == Approx(rest.col(0)(2 * biped().find("left_foot") + 1)).margin(25));
}

TEST_CASE("ways are scaled by the legs, or left out") {
  PoseMatrix motion = walker({});
  for (Eigen::Index f = 0; f < 24; ++f)
    for (Eigen::Index r = 0; r < 34; r += 2) motion(r, f) += 10 * double(f);
  const PoseMatrix rest = walker({.frames = 1, .size_px = 400});
  CHECK(wornBy(rest, motion, biped())(0, 23) - rest(0, 0) == Approx(460));
  CHECK(wornBy(rest, motion, biped(), {.travels = false})(0, 23) == Approx(rest(0, 0)));
}

TEST_CASE("a clip turns the joints as the motion turns the bones") {
  const PoseMatrix motion = walker({.lean_rad = 0.3});
  std::vector<double> times_s;
  for (int f = 0; f < 24; ++f) times_s.push_back(f / 24.);
  const Clip clip = clipOfMotion(motion, times_s, true, biped(), "test");
  CHECK(clip.duration_s() == Approx(1));
  const PoseMatrix directions = boneDirections(motion, biped());
  const auto track = [&](const std::string& name) {
    for (const JointTrack& t : clip.tracks)
      if (t.joint == name) return t;
    return JointTrack{};
  };
  // Down the chain of the left arm: the canonical bone, turned by all rotations above it.
  for (const int f : {0, 5, 17}) {
    Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
    for (const char* name : {"pelvis", "body", "neck", "left_shoulder"})
      turn = turn * track(name).rotations[std::size_t(f)];
    const Eigen::Vector3f bone = turn * track("left_shoulder").bone;
    const Eigen::Vector2d wanted = jointOf(directions, biped().find("left_elbow"), f);
    CHECK(bone.x() == Approx(wanted.x()).margin(1e-5));
    CHECK(bone.y() == Approx(-wanted.y()).margin(1e-5));
  }
  CHECK(track("left_knee").rotations.front().isApprox(track("left_knee").rotations.back()));
  CHECK(track("left_hand").joint.empty());
}
