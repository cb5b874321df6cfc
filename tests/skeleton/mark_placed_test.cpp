// What a person has placed is sure.
#include "libskel/skeleton/mark_placed.h"

#include "libskel/skeleton/skeleton_file.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

Skeleton fourJoints() {
  Skeleton skeleton;
  for (const double confidence : {1., .5, .5, .25})
    skeleton.joints.push_back({.name = "j", .confidence = confidence, .origin = JointOrigin::kRecognized});
  skeleton.joints.push_back({.name = "between", .confidence = .25, .origin = JointOrigin::kDerived});
  return skeleton;
}

}  // namespace

TEST_CASE("the doubt of a skeleton goes as its doubtful joints are placed, in whatever order") {
  Skeleton skeleton = fourJoints();
  double confidence = .0625;  // as if joints were right or wrong by themselves
  CHECK(markPlaced(skeleton, {}, confidence) == confidence);
  CHECK(markPlaced(skeleton, {0}, confidence) == Approx(confidence));  // nobody doubted that one
  confidence = markPlaced(skeleton, {1}, confidence);
  CHECK(confidence == Approx(.125));
  CHECK(skeleton.joints[1].origin == JointOrigin::kEdited);
  CHECK_FALSE(allPlaced(skeleton));
  confidence = markPlaced(skeleton, {3}, confidence);
  CHECK(confidence == Approx(.5));
  CHECK(markPlaced(skeleton, {2}, confidence) == 1);
  CHECK(allPlaced(skeleton));
  Skeleton other = fourJoints();
  CHECK(markPlaced(other, {3, 1}, .0625) == Approx(.5));
}
