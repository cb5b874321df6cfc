#include "libskel/style/transfer.h"

#include "libskel/core/error.h"
#include "libskel/style/in_between.h"
#include "libskel/style/track_joints.h"
#include "tests/style/walker.h"
#include "tests/support/catch.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

PoseMatrix canonical(const Gait& gait) { return canonicalPoses(walker(gait), biped()); }

const Gait kPlain{.frames = 24};
// Leans forward, holds its arms out, takes small steps, and begins elsewhere in its cycle.
const Gait kStiff{
    .frames = 17, .phase_rad = 2, .legs_rad = 0.25, .arms_rad = 0.05, .lean_rad = 0.4, .reach_rad = 1.3};

Eigen::VectorXd meanBones(const PoseMatrix& poses) { return boneDirections(poses, biped()).rowwise().mean(); }

}  // namespace

TEST_CASE("phases are found where a motion looks as the other does at that moment") {
  for (const int frames : {12, 24, 40}) {
    Gait shifted = kPlain;
    shifted.frames = frames;
    shifted.phase_rad = 1.2;
    const PhaseAlignment found = alignPhases(canonical(kPlain), canonical(shifted), {true, true});
    for (int f = 0; f < 24; ++f) {
      double wanted = (f / 24.0 - 1.2 / (2 * std::numbers::pi)) * frames;
      wanted -= frames * std::floor(wanted / frames);
      double off = std::abs(found.style_frame[std::size_t(f)] - wanted);
      off = std::min(off, frames - off);
      CAPTURE(frames, f, wanted, found.style_frame[std::size_t(f)]);
      CHECK(off < 0.06 * frames);
    }
  }
}

TEST_CASE("a content of two cycles goes twice round a style of one") {
  Gait twice = kPlain;
  twice.frames = 40;
  twice.cycles = 2;
  const PoseMatrix style = canonical({.frames = 16, .legs_rad = 0.3});
  const PhaseAlignment found = alignPhases(canonical(twice), style, {true, true});
  const PoseMatrix at = posesAt(style, found.style_frame, true);
  CHECK(correlation(stride(at), stride(canonical(twice))) > 0.98);
}

TEST_CASE("a cycle of 800 frames is one cycle, though frames that follow each other are alike") {
  Gait slow = kPlain, slow_style = kStiff;
  slow.frames = slow_style.frames = 800;
  const PhaseAlignment found = alignPhases(canonical(slow), canonical(slow_style), {true, true});
  int rounds = 0;
  for (std::size_t f = 0; f < found.style_frame.size(); ++f) {
    const double next = found.style_frame[(f + 1) % found.style_frame.size()];
    rounds += next < found.style_frame[f] - 400;
  }
  CHECK(rounds == 1);
}

TEST_CASE("motions whose frames are too many to be compared are refused by their names") {
  const auto refused = [](int content, int style, bool loop, const std::string& why) {
    const PoseMatrix a = canonical({.frames = content, .cycles = content / 24.0}),
                     b = canonical({.frames = style, .cycles = style / 24.0});
    CHECK_THROWS_WITH(
        alignPhases(a, b, {loop, loop, "a.motion.json", "b.motion.json"}),
        Contains("a.motion.json: has ") && Contains(" and b.motion.json has ") && Contains(why));
  };
  refused(4008, 4008, false, "one times the other are 16 million at most");
  refused(1608, 9960, true, "16 million");
  // A style of 100 cycles is taken for one, so that each frame of the content may go on by hundreds of it.
  refused(2400, 2400, true, "of the content's, too many to choose from; cut the style to one cycle");
}

TEST_CASE("motions that do not loop are aligned from end to end") {
  Gait half = kPlain;
  half.cycles = 0.5;
  Gait slow = half;
  slow.frames = 37;
  const PhaseAlignment found = alignPhases(canonical(half), canonical(slow), {false, false});
  CHECK(found.style_frame.front() < 3);
  CHECK(found.style_frame.back() > 33);
  for (std::size_t f = 1; f < found.style_frame.size(); ++f)
    CHECK(found.style_frame[f] >= found.style_frame[f - 1] - 1e-9);
}

TEST_CASE("the style changes how the content holds itself, not when it steps") {
  const MotionPair pair{canonical(kPlain), canonical(kStiff), true, true};
  const Transfer result = transferStyle({pair});
  const PoseMatrix& poses = result.poses[0];
  const Eigen::VectorXd from = meanBones(pair.content), to = meanBones(pair.style), now = meanBones(poses);
  CHECK((now - to).norm() < 0.3 * (from - to).norm());
  CHECK(correlation(stride(poses), stride(pair.content)) > 0.95);
  CHECK(result.coding.basis.minCoeff() >= 0);
}

TEST_CASE("amount 0 is the content, more is more") {
  const MotionPair pair{canonical(kPlain), canonical(kStiff), true, true};
  TransferOptions options;
  const auto at = [&](double amount) {
    options.amount = amount;
    return transferStyle({pair}, options).poses[0];
  };
  CHECK(at(0) == pair.content);
  const double half = (at(0.5) - pair.content).norm(), whole = (at(1) - pair.content).norm(),
               over = (at(1.5) - pair.content).norm();
  CHECK(half == Approx(0.5 * whole));
  CHECK(over == Approx(1.5 * whole));
}

TEST_CASE("a motion in its own style stays as it is") {
  const MotionPair pair{canonical(kPlain), canonical(kPlain), true, true};
  CHECK((transferStyle({pair}).poses[0] - pair.content).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("components are matched by what they say of the actions") {
  std::vector<MotionPair> pairs;
  std::vector<std::string> actions;
  for (int i = 0; i < 3; ++i) {
    Gait content = kPlain, style = kStiff;
    content.reach_rad = i;
    style.reach_rad = i + 0.3;
    pairs.push_back({canonical(content), canonical(style), true, true});
    actions.push_back("action " + std::to_string(i));
  }
  TransferOptions options;
  options.coding.components = 3;
  const Transfer result = transferBySignatures(pairs, actions, options);
  REQUIRE(result.poses.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::VectorXd from = meanBones(pairs[i].content), to = meanBones(pairs[i].style);
    CHECK((meanBones(result.poses[i]) - to).norm() < (from - to).norm());
  }
  options.coding.components = 4;
  CHECK_THROWS_AS(transferBySignatures(pairs, actions, options), UsageError);
}

TEST_CASE("nothing, one frame and standing still") {
  CHECK_THROWS_AS(transferStyle({}), UsageError);
  CHECK_THROWS_AS(transferStyle({{PoseMatrix(34, 0), canonical(kPlain), false, false}}), UsageError);
  const PoseMatrix one = canonical(kPlain).leftCols(1), still = one.replicate(1, 6);
  CHECK(transferStyle({{one, canonical(kStiff), false, true}}).poses[0].allFinite());
  CHECK(transferStyle({{still, still, true, true}}).poses[0].allFinite());
  CHECK((transferStyle({{still, still, true, true}}).poses[0] - still).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("frames between key frames meet them and move as the source does") {
  const PoseMatrix source = walker(kPlain);
  const std::vector<int> keys = {0, 5, 11, 20};
  PoseMatrix poses(34, 4);
  for (int k = 0; k < 4; ++k) poses.col(k) = source.col(keys[std::size_t(k)]).array() + 7 * k;
  for (const bool loops : {false, true}) {
    const PoseMatrix all = inBetweens(source, keys, poses, loops);
    for (int k = 0; k < 4; ++k) CHECK(all.col(keys[std::size_t(k)]) == poses.col(k));
    CHECK(unevenness(all, 200) < 3 * unevenness(source, 200) + 0.01);
    // Between 5 and 11 the shift goes from 7 to 14.
    const Eigen::VectorXd shift = all.col(8) - source.col(8);
    CHECK(shift.minCoeff() >= 7 - 1e-9);
    CHECK(shift.maxCoeff() <= 14 + 1e-9);
  }
  CHECK((inBetweens(source, keys, poses, false).col(23) - source.col(23)).minCoeff() == Approx(21));
  CHECK((inBetweens(source, keys, poses, true).col(23) - source.col(23)).minCoeff() < 21);
}

TEST_CASE("key poses that are the source's own give the source") {
  const PoseMatrix source = walker(kPlain);
  const std::vector<int> keys = {2, 9};
  PoseMatrix poses(34, 2);
  poses << source.col(2), source.col(9);
  CHECK((inBetweens(source, keys, poses, true) - source).cwiseAbs().maxCoeff() < 1e-9);
  const PoseMatrix still = source.col(0).replicate(1, 10);
  CHECK((inBetweens(still, keys, still.leftCols(2), false) - still).cwiseAbs().maxCoeff() < 1e-9);
}
