#include "libskel/skeleton/frontal.h"

#include <algorithm>
#include <array>

namespace skel {
namespace {

// Of the trunk's length: where the shoulders are nearer to each other than the first it is seen from the
// side, farther than the second from the front.
constexpr double kSideShoulders = 0.2, kFrontShoulders = 0.5;

}  // namespace

double frontal(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  if (body_plan.from_side) return 0;
  std::array<Eigen::Vector2d, 4> at;
  const std::array<const char*, 4> names = {"left_shoulder", "right_shoulder", "pelvis", "neck"};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const int joint = skeleton.find(names[i]);
    if (joint < 0) return 1;
    at[i] = skeleton.joints[static_cast<std::size_t>(joint)].image;
  }
  const double wide = (at[0] - at[1]).norm() / std::max((at[2] - at[3]).norm(), 1.0);
  return std::clamp((wide - kSideShoulders) / (kFrontShoulders - kSideShoulders), 0.0, 1.0);
}

}  // namespace skel
