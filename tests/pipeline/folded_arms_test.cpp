// Arms whose forearm lies on the upper arm.
#include "libskel/pipeline/folded_arms.h"

#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

TEST_CASE("an arm that was folded onto itself came off, as forearm and upper arm cannot be told there") {
  const SkeletonTemplate plan = loadTemplate("biped");
  Skeleton skeleton = capsuleSkeleton({});
  const auto at = [&](const char* name) { return skeleton.index(name); };
  const auto joint = [&](const char* name) { return static_cast<std::uint16_t>(at(name)); };
  SkinWeights weights;
  weights.joints.setZero(3, 4);
  weights.weights.setZero(3, 4);
  weights.joints.row(0) << joint("body"), joint("left_elbow"), joint("left_shoulder"), 0;
  weights.weights.row(0) << 0.4F, 0.35F, 0.25F, 0;
  weights.joints(1, 0) = joint("left_hand"), weights.weights(1, 0) = 1;
  weights.joints(2, 0) = joint("right_elbow"), weights.weights(2, 0) = 1;

  SkinWeights open = weights;
  foldArms(skeleton, plan, open);
  CHECK(open.joints == weights.joints);
  CHECK(open.weights == weights.weights);

  const Eigen::Vector2d shoulder = skeleton.joints[std::size_t(at("left_shoulder"))].image,
                        elbow = skeleton.joints[std::size_t(at("left_elbow"))].image;
  skeleton.joints[std::size_t(at("left_hand"))].image =
      elbow + 1.1 * (shoulder - elbow) + Eigen::Vector2d(3, 0);
  foldArms(skeleton, plan, weights);
  CHECK(weights.joints(0, 0) == joint("left_shoulder"));
  CHECK(weights.weights(0, 0) == Approx(0.6F));
  CHECK(weights.joints(0, 1) == joint("body"));
  CHECK(weights.weights(0, 1) == Approx(0.4F));
  CHECK(weights.weights.row(0).tail(2).isZero());
  CHECK(weights.joints(1, 0) == joint("left_shoulder"));
  CHECK(weights.joints(2, 0) == joint("right_elbow"));  // the other arm
}
