#include "libskel/style/track_joints.h"

#include "libskel/core/rng.h"
#include "tests/style/walker.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

void swapLimbs(PoseMatrix& poses, Eigen::Index frame, JointClass limb_class) {
  const PoseMatrix before = poses;
  for (const TemplateLimb& limb : biped().limbs)
    for (const int j : limb.joints)
      if (limb.limb_class == limb_class)
        poses.col(frame).segment<2>(2 * j) = jointOf(before, biped().joints[std::size_t(j)].mirror, frame);
}

JointSightings sightings(const PoseMatrix& places, bool loop) {
  return {places, Eigen::MatrixXd::Constant(17, places.cols(), 0.9), {}, 200, loop};
}

// A part of the body may come back mirrored throughout, which is as good.
double worst(const PoseMatrix& found, const PoseMatrix& truth) {
  PoseMatrix other = truth;
  for (Eigen::Index f = 0; f < truth.cols(); ++f) swapLimbs(other, f, JointClass::kLeg);
  const auto off = [&](const PoseMatrix& to, std::vector<std::string> joints) {
    double most = 0;
    for (const std::string& joint : joints)
      for (const std::string side : {"left_", "right_"})
        most =
            std::max(most, (found - to).middleRows(2 * biped().find(side + joint), 2).cwiseAbs().maxCoeff());
    return most;
  };
  return std::max(std::min(off(truth, {"knee", "foot"}), off(other, {"knee", "foot"})),
                  std::min(off(truth, {"hip"}), off(other, {"hip"})));
}

}  // namespace

TEST_CASE("limbs that are taken for each other in some frames get their names back") {
  const PoseMatrix truth = walker({.frames = 30, .cycles = 2});
  PoseMatrix seen = truth;
  for (const int f : {3, 4, 5, 11, 20, 21}) swapLimbs(seen, f, JointClass::kLeg);
  for (const int f : {8, 9, 25}) swapLimbs(seen, f, JointClass::kHand);
  for (const bool loop : {false, true}) {
    const JointTracks tracks = trackJoints(sightings(seen, loop), biped(), {.smoothness = 0});
    CHECK(tracks.places == truth);
    CHECK(tracks.legs_swapped[4]);
    CHECK_FALSE(tracks.legs_swapped[6]);
    CHECK(tracks.arms_swapped[25]);
  }
}

TEST_CASE("legs that cross go on as they went, though each frame calls the left one right") {
  const PoseMatrix truth = walker({.frames = 32, .cycles = 2, .phase_rad = 0.1});
  PoseMatrix seen = truth;
  // As a recognition does that looks at one frame: left is what is further right.
  for (Eigen::Index f = 0; f < 32; ++f)
    if (stride(truth)(f) < 0) swapLimbs(seen, f, JointClass::kLeg);
  const JointTracks tracks = trackJoints(sightings(seen, true), biped(), {.smoothness = 0});
  // But for the frame in which they meet: there they are less than 6 px apart.
  CHECK(worst(tracks.places, truth) < 6);
}

TEST_CASE("colours tell limbs apart where places do not") {
  PoseMatrix places = walker({.frames = 12, .legs_rad = 0});
  JointSightings seen = sightings(places, false);
  seen.colors = Eigen::MatrixXd::Constant(51, 12, 0.5);
  const auto paint = [&](const std::string& joint, Eigen::Index f, double shade) {
    seen.colors.col(f).segment<3>(3 * biped().find(joint)).setConstant(shade);
  };
  for (Eigen::Index f = 0; f < 12; ++f)
    for (const std::string joint : {"hip", "knee", "foot"}) {
      const bool swapped = f >= 5 && f < 8;
      paint("left_" + joint, f, swapped ? 0.2 : 0.8);
      paint("right_" + joint, f, swapped ? 0.8 : 0.2);
    }
  const JointTracks tracks = trackJoints(seen, biped(), {.smoothness = 0});
  for (std::size_t f = 0; f < 12; ++f) CHECK(tracks.legs_swapped[f] == (f >= 5 && f < 8));
}

TEST_CASE("legs that a recognition never crosses are told by their colour over the whole film") {
  const PoseMatrix truth = walker({.frames = 24, .cycles = 2, .phase_rad = 0.1});
  JointSightings seen = sightings(truth, true);
  seen.colors = Eigen::MatrixXd::Constant(51, 24, 0.5);
  for (Eigen::Index f = 0; f < 24; ++f) {
    const bool crossed = stride(truth)(f) < 0;
    for (const std::string joint : {"knee", "foot"}) {
      const int l = biped().find("left_" + joint), r = biped().find("right_" + joint);
      // Side by side even where they meet, the left one always further right: it looks as if they turned
      // back.
      const Eigen::Vector2d middle = (jointOf(truth, l, f) + jointOf(truth, r, f)) / 2,
                            half = (jointOf(truth, l, f) - jointOf(truth, r, f)) / 2;
      const Eigen::Vector2d apart(std::hypot(half.x(), 5), crossed ? -half.y() : half.y());
      seen.places.col(f).segment<2>(2 * l) = middle + apart;
      seen.places.col(f).segment<2>(2 * r) = middle - apart;
      seen.colors.col(f).segment<3>(3 * l).setConstant(crossed ? 0.7 : 0.8);
      seen.colors.col(f).segment<3>(3 * r).setConstant(crossed ? 0.8 : 0.7);
    }
  }
  const JointTracks tracks = trackJoints(seen, biped(), {.smoothness = 0});
  const bool mirrored = tracks.legs_swapped[0] != (stride(truth)(0) < 0);  // which is called left is open
  for (Eigen::Index f = 0; f < 24; ++f)
    CHECK(tracks.legs_swapped[std::size_t(f)] == ((stride(truth)(f) < 0) != mirrored));
}

TEST_CASE("hips on the wrong side of their legs in every frame change sides") {
  const PoseMatrix truth = walker({.frames = 12});
  PoseMatrix seen = truth;
  for (Eigen::Index f = 0; f < 12; ++f) {
    const int l = biped().find("left_hip"), r = biped().find("right_hip");
    seen.col(f).segment<2>(2 * l).swap(seen.col(f).segment<2>(2 * r));
  }
  const JointTracks tracks = trackJoints(sightings(seen, true), biped(), {.smoothness = 0});
  CHECK(worst(tracks.places, truth) < 1e-9);
}

TEST_CASE("noise is smoothed away, and hands that jump to the head come back") {
  const PoseMatrix truth = walker({.frames = 24});
  Rng rng(3);
  PoseMatrix seen = truth;
  for (double& x : seen.reshaped()) x += 1.5 * rng.normal();
  const int hand = biped().find("left_hand"), elbow = biped().find("left_elbow"), head = biped().find("head");
  for (const int f : {6, 7, 15}) {
    seen.col(f).segment<2>(2 * hand) = jointOf(truth, head, f);
    seen.col(f).segment<2>(2 * elbow) = jointOf(truth, head, f) + Eigen::Vector2d(5, 10);
  }
  const JointTracks tracks = trackJoints(sightings(seen, true), biped());
  CHECK(unevenness(tracks.places, 200) < 0.5 * unevenness(seen, 200));
  const PoseMatrix off = tracks.places - truth;
  CHECK(std::sqrt(off.squaredNorm() / double(off.size())) < 1.5);
  for (const int f : {6, 7, 15}) {
    CHECK((jointOf(tracks.places, hand, f) - jointOf(truth, hand, f)).norm() < 8);
    CHECK(tracks.confidences(hand, f) < 0.3);
    CHECK(tracks.confidences(elbow, f) < 0.3);
  }
}

TEST_CASE("the legs of a film of few frames a second swing as they are seen") {
  const PoseMatrix truth = walker({.frames = 8});
  JointSightings seen = sightings(truth, true);
  seen.frame_rate = 12;
  const JointTracks tracks = trackJoints(seen, biped());
  const int foot = biped().find("left_foot"), pelvis = biped().find("pelvis");
  const auto swing = [&](const PoseMatrix& poses) {
    const Eigen::RowVectorXd x = poses.row(2 * foot) - poses.row(2 * pelvis);
    return x.maxCoeff() - x.minCoeff();
  };
  CHECK(swing(tracks.places) > .9 * swing(truth));
}

TEST_CASE("one frame, two frames and joints that were never seen come back in one piece") {
  const PoseMatrix truth = walker({.frames = 5});
  CHECK(trackJoints(sightings(truth.leftCols(1), false), biped()).places == truth.leftCols(1));
  CHECK(trackJoints(sightings(truth.leftCols(2), true), biped()).places.allFinite());
  JointSightings seen = sightings(truth, false);
  seen.confidences.setZero();
  CHECK(trackJoints(seen, biped()).places.allFinite());
  CHECK(unevenness(truth.leftCols(2), 200) == 0);
}
