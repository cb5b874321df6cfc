#include "libskel/skeleton/mark_placed.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

double doubtOf(const Skeleton& skeleton) {
  constexpr double kLeast = 1e-3;  // as files keep confidences
  double sum = 0;
  for (const Joint& joint : skeleton.joints)
    if (joint.origin != JointOrigin::kDerived) sum -= std::log(std::clamp(joint.confidence, kLeast, 1.0));
  return sum;
}

}  // namespace

double markPlaced(Skeleton& skeleton, const std::vector<int>& placed, double confidence) {
  if (placed.empty()) return confidence;
  const double before = doubtOf(skeleton);
  for (const int index : placed) {
    Joint& joint = skeleton.joints[static_cast<std::size_t>(index)];
    joint.confidence = 1;
    joint.origin = JointOrigin::kEdited;
  }
  const double left = doubtOf(skeleton);
  return left > 0 ? std::pow(confidence, std::min(left / before, 1.0)) : 1;
}

void followPlaced(Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  constexpr double kRounded_px = .011;  // of a mean of two that files keep to the hundredth
  const auto jointOf = [&](int joint_of_plan) -> Joint* {
    const int found = skeleton.find(body_plan.joints[static_cast<std::size_t>(joint_of_plan)].name);
    return found < 0 ? nullptr : &skeleton.joints[static_cast<std::size_t>(found)];
  };
  for (int j = 0; j < static_cast<int>(body_plan.joints.size()); ++j) {
    const auto& derived = body_plan.joints[static_cast<std::size_t>(j)].derived;
    if (!derived || derived->rule != DerivationRule::kMidpoint) continue;
    Joint* const middle_joint = jointOf(j);
    const Joint *const first = jointOf(derived->from[0]), *const second = jointOf(derived->from[1]);
    if (!middle_joint || !first || !second || middle_joint->origin == JointOrigin::kEdited) continue;
    Joint& joint = *middle_joint;
    const Joint &a = *first, &b = *second;
    const Eigen::Vector2d middle = (a.image + b.image) / 2;
    const bool placed = a.origin == JointOrigin::kEdited || b.origin == JointOrigin::kEdited;
    if (!placed || (joint.image - middle).cwiseAbs().maxCoeff() < kRounded_px) continue;
    joint.image = middle;
    joint.confidence = std::min(a.confidence, b.confidence);
    joint.origin = JointOrigin::kDerived;
  }
}

bool allPlaced(const Skeleton& skeleton) {
  return std::all_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
    return joint.origin == JointOrigin::kEdited || joint.origin == JointOrigin::kDerived;
  });
}

}  // namespace skel
