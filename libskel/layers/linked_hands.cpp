#include "libskel/layers/linked_hands.h"

#include <algorithm>
#include <array>
#include <vector>

#include "libskel/core/segment.h"
#include "libskel/image/mask_parts.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

// Lengths as shares of the longer forearm.
constexpr double kHand = .35;   // around its joint
constexpr double kBeyond = .3;  // off the bones, what is said to be an arm is what it holds
constexpr int kTouched = 3;     // px around each hand

}  // namespace

bool areHandsLinked(const PartPicture& picture, const PartSkeleton& skeleton) {
  std::array<std::array<Vec, 3>, 2> arms;
  double forearm = 0;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      arms[k][i] = (skeleton.limbs[k][i] - Vec(picture.box.x0, picture.box.y0)) * picture.scale;
    forearm = std::max(forearm, (arms[k][2] - arms[k][1]).norm());
  }
  const auto isAtHand = [&](std::size_t k, const Vec& p) {
    return (p - arms[k][2]).norm() < kHand * forearm;
  };
  const auto isOffBones = [&](const Vec& p) {
    return std::all_of(arms.begin(), arms.end(), [&](const std::array<Vec, 3>& arm) {
      return std::min(distanceToSegment<Vec>(p, arm[0], arm[1]), distanceToSegment<Vec>(p, arm[1], arm[2])) >
             kBeyond * forearm;
    });
  };
  const auto isHandOrHeld = [&](int part, const Vec& p) {
    const bool arm = part == static_cast<int>(limbPart(0)) || part == static_cast<int>(limbPart(1));
    return part == static_cast<int>(Part::kThing) ||
           (arm && (isAtHand(0, p) || isAtHand(1, p) || isOffBones(p)));
  };
  Plane8 held = Plane8::Zero(picture.part.rows(), picture.part.cols());
  for (int y = 0; y < held.rows(); ++y)
    for (int x = 0; x < held.cols(); ++x)
      held(y, x) = picture.mask(y, x) != 0 && isHandOrHeld(picture.part(y, x), Vec(x + .5, y + .5));
  const MaskParts parts = maskParts(held);
  std::vector<std::array<int, 2>> at_hands(parts.size.size());
  for (const MaskParts::Run& run : parts.runs)
    for (int x = run.x0; x < run.x1; ++x)
      for (std::size_t k = 0; k < 2; ++k)
        at_hands[static_cast<std::size_t>(run.part)][k] += isAtHand(k, Vec(x + .5, run.y + .5));
  return std::any_of(at_hands.begin(), at_hands.end(), [](const std::array<int, 2>& touched) {
    return std::min(touched[0], touched[1]) >= kTouched;
  });
}

}  // namespace skel
