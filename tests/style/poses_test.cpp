#include "libskel/style/poses.h"

#include "libskel/core/error.h"
#include "tests/style/walker.h"
#include "tests/support/catch.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

MotionFile motionOf(const PoseMatrix& poses) {
  MotionFile motion;
  motion.frame_rate = 10;
  for (Eigen::Index f = 0; f < poses.cols(); ++f) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.time_s = double(f) / 10;
    for (int j = 0; j < 17; ++j)
      frame.joints.push_back(PlacedJoint{jointOf(poses, j, f), 1, JointOrigin::kEdited});
  }
  return motion;
}

}  // namespace

TEST_CASE("directions and lengths of bones give the poses back") {
  const PoseMatrix poses = walker({});
  const PoseMatrix again =
      posesFromBones(boneDirections(poses, biped()), boneLengths(poses, biped()), poses.topRows(2), biped());
  CHECK((again - poses).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("canonical poses lie in the unit box, and know neither size nor place nor build") {
  Gait gait;
  const PoseMatrix poses = walker(gait), canonical = canonicalPoses(poses, biped());
  CHECK(canonical.minCoeff() >= 0);
  CHECK(canonical.maxCoeff() <= 1);
  gait.size_px = 900;
  CHECK((canonicalPoses(walker(gait), biped()) - canonical).cwiseAbs().maxCoeff() < 1e-9);
  const Eigen::VectorXd longer = boneLengths(poses, biped()).array() * Eigen::ArrayXd::LinSpaced(17, 1, 3);
  const PoseMatrix other = posesFromBones(boneDirections(poses, biped()), longer, poses.topRows(2), biped());
  CHECK((canonicalPoses(other, biped()) - canonical).cwiseAbs().maxCoeff() < 1e-9);
  CHECK((boneDirections(canonical, biped()) - boneDirections(poses, biped())).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("a figure that walks to the right looks there, and to the left in a mirror") {
  const PoseMatrix poses = walker({});
  CHECK(facing(poses, biped()) > 0.1);
  const PoseMatrix mirrored = mirroredPoses(poses, biped());
  CHECK(facing(mirrored, biped()) == Approx(-facing(poses, biped())));
  CHECK((mirroredPoses(mirrored, biped()) - poses).cwiseAbs().maxCoeff() < 1e-9);
  Gait straight;
  straight.legs_rad = straight.arms_rad = 0;
  PoseMatrix standing = walker(straight);
  for (const char* joint : {"left_hand", "right_hand", "left_foot", "right_foot"}) {
    const int j = biped().find(joint), parent = biped().joints[std::size_t(j)].parent;
    standing.row(2 * j) = standing.row(2 * parent);
  }
  CHECK(std::abs(facing(standing, biped())) < 0.05);
}

TEST_CASE("a whole cycle is a loop, half of one is not") {
  CHECK(isLoop(walker({})));
  Gait half;
  half.cycles = 0.4;
  CHECK_FALSE(isLoop(walker(half)));
  CHECK_FALSE(isLoop(walker({}).leftCols(3)));
}

TEST_CASE("joints that a frame lacks lie between those of its neighbours") {
  const PoseMatrix poses = walker({});
  MotionFile motion = motionOf(poses);
  const std::size_t hand = std::size_t(biped().find("left_hand"));
  motion.frames[3].joints[hand].reset();
  motion.frames[0].joints[hand].reset();
  motion.frames[23].joints[hand].reset();
  const PoseMatrix found = posesOf(motion, biped(), "m");
  CHECK((jointOf(found, int(hand), 3) - 0.5 * (jointOf(poses, int(hand), 2) + jointOf(poses, int(hand), 4)))
            .norm() < 1e-9);
  CHECK(jointOf(found, int(hand), 0) == jointOf(poses, int(hand), 1));
  CHECK(jointOf(found, int(hand), 23) == jointOf(poses, int(hand), 22));
  CHECK(jointOf(found, int(hand), 7) == jointOf(poses, int(hand), 7));
  for (MotionFrame& frame : motion.frames) frame.joints[hand].reset();
  CHECK_THROWS_WITH(posesOf(motion, biped(), "m.motion.json"),
                    Contains("m.motion.json: no frame knows the joint \"left_hand\""));
}

TEST_CASE("bones of length 0 point somewhere") {
  const PoseMatrix none = PoseMatrix::Zero(34, 2);
  CHECK(boneDirections(none, biped()).allFinite());
  CHECK(canonicalPoses(none, biped()).allFinite());
  // All bones upwards: at the border of the box, not beyond it.
  CHECK(canonicalPoses(none, biped()).minCoeff() >= 0);
}

TEST_CASE("joints that only the first and the last of 100,000 frames know lie between") {
  const PoseMatrix poses = walker({});
  MotionFile motion;
  motion.frames.resize(100'000);
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    motion.frames[f].time_s = double(f);
    motion.frames[f].joints.resize(17);
  }
  for (int j = 0; j < 17; ++j) {
    motion.frames.front().joints[std::size_t(j)] = PlacedJoint{jointOf(poses, j, 0), 1};
    motion.frames.back().joints[std::size_t(j)] = PlacedJoint{jointOf(poses, j, 1), 1};
  }
  const PoseMatrix all = posesOf(motion, biped(), "m");
  CHECK((all.col(0) - poses.col(0)).norm() < 1e-9);
  CHECK((all.col(25'000) - (0.75 * poses.col(0) + 0.25 * poses.col(1))).norm() < 0.01);
}
