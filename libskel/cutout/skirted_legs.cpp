#include "libskel/cutout/skirted_legs.h"

#include <algorithm>
#include <array>

#include "libskel/cutout/limb_plane.h"

namespace skel {
namespace {

constexpr double kBelowHip = 0.5;  // of the thigh
constexpr double kAcross = 0.18;   // of a bone: standard deviation along it

bool isPartOfLeg(std::uint8_t part) {
  return part == std::uint8_t(Part::kRightLeg) || part == std::uint8_t(Part::kLeftLeg);
}

// Where a leg touches the rest of the figure but the other leg: pairs of pixels.
struct LegBorder {
  int skirt = 0, other = 0;
  double along_sum = 0, along_squares = 0;  // of those with the skirt: LimbBones::Near::along

  bool isHem() const {
    if (skirt <= other) return false;
    const double mean = along_sum / skirt;
    return mean >= kBelowHip && along_squares / skirt - mean * mean <= kAcross * kAcross;
  }
};

LegBorder borderOf(const DrawnFigure& figure, std::size_t limb) {
  const Plane8 &part = figure.layers.part, &mask = figure.silhouette.mask;
  const LimbBones bones = limbBones(figure, limb);
  const auto own = std::uint8_t(limbPart(int(limb) - 1));
  LegBorder border;
  const auto touch = [&](int y, int x, int v, int u) {
    if (part(y, x) != own || isPartOfLeg(part(v, u))) return;
    if (part(v, u) != std::uint8_t(Part::kSkirt)) {
      ++border.other;
      return;
    }
    ++border.skirt;
    const double along = bones.nearest(Eigen::Vector2d(x, y)).along;
    border.along_sum += along, border.along_squares += along * along;
  };
  for (int y = 0; y < mask.rows(); ++y)
    for (int x = 0; x < mask.cols(); ++x)
      for (const auto& [v, u] : {std::pair(y, x + 1), std::pair(y + 1, x)})
        if (v < mask.rows() && u < mask.cols() && mask(y, x) != 0 && mask(v, u) != 0)
          touch(y, x, v, u), touch(v, u, y, x);
  return border;
}

}  // namespace

LayerMap withSkirtedLegs(const DrawnFigure& figure) {
  LayerMap layers = figure.layers;
  const Plane8 &part = figure.layers.part, &mask = figure.silhouette.mask;
  if (part.size() == 0 || !(part == std::uint8_t(Part::kSkirt)).any()) return layers;
  Plane8 limbs = layers.any() ? layers.limb : Plane8(Plane8::Zero(mask.rows(), mask.cols()));
  std::vector<int> legs;
  for (std::size_t limb = 1; limb <= std::min<std::size_t>(4, figure.body_plan.limbs.size()); ++limb) {
    if (!isLeg(figure.body_plan, figure.body_plan.limbs[limb - 1])) continue;
    const int number = int(limb);
    const Plane8 own = (mask != 0 && part == std::uint8_t(limbPart(number - 1))).cast<std::uint8_t>();
    if (!borderOf(figure, limb).isHem()) return layers;
    limbs = (own != 0).select(Plane8::Constant(mask.rows(), mask.cols(), std::uint8_t(number)), limbs);
    legs.push_back(number);
  }
  layers.limb = std::move(limbs);
  for (const int leg : legs)
    if (std::count(layers.far.begin(), layers.far.end(), leg) == 0) layers.far.push_back(leg);
  return layers;
}

}  // namespace skel
