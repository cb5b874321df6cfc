#include "libskel/pipeline/folded_arms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace skel {
namespace {

// In the picture.
bool isFolded(const Skeleton& skeleton, const std::array<int, 3>& arm) {
  constexpr double kOpen_rad = 20 * std::numbers::pi / 180;
  constexpr double kLeastForearm = 0.6;  // of the upper arm's length
  const Eigen::Vector2d elbow = skeleton.joints[std::size_t(arm[1])].image,
                        upper = skeleton.joints[std::size_t(arm[0])].image - elbow,
                        fore = skeleton.joints[std::size_t(arm[2])].image - elbow;
  const double lengths = upper.norm() * fore.norm();
  return lengths > 0 && fore.norm() > kLeastForearm * upper.norm() &&
         upper.dot(fore) > std::cos(kOpen_rad) * lengths;
}

void moveWeights(const std::array<int, 3>& arm, SkinWeights& weights) {
  using Influence = std::pair<float, std::uint16_t>;
  for (Eigen::Index v = 0; v < weights.joints.rows(); ++v) {
    float of_arm = 0;
    std::vector<Influence> others;
    for (int k = 0; k < weights.joints.cols(); ++k) {
      const int joint = weights.joints(v, k);
      if (std::find(arm.begin(), arm.end(), joint) != arm.end())
        of_arm += weights.weights(v, k);
      else
        others.emplace_back(weights.weights(v, k), joint);
    }
    if (of_arm == 0) continue;
    others.emplace_back(of_arm, static_cast<std::uint16_t>(arm[0]));
    std::stable_sort(others.begin(), others.end(),
                     [](const Influence& a, const Influence& b) { return a.first > b.first; });
    others.resize(4);
    for (int k = 0; k < 4; ++k)
      weights.weights(v, k) = others[std::size_t(k)].first,
                         weights.joints(v, k) = others[std::size_t(k)].second;
  }
}

}  // namespace

void foldArms(const Skeleton& skeleton, const SkeletonTemplate& body_plan, SkinWeights& weights) {
  for (const TemplateLimb& limb : body_plan.limbs) {
    if (limb.limb_class != JointClass::kHand || body_plan.from_side) continue;
    std::array<int, 3> arm;
    for (std::size_t k = 0; k < 3; ++k)
      arm[k] = skeleton.find(body_plan.joints[std::size_t(limb.joints[k])].name);
    if (std::find(arm.begin(), arm.end(), -1) == arm.end() && isFolded(skeleton, arm))
      moveWeights(arm, weights);
  }
}

}  // namespace skel
