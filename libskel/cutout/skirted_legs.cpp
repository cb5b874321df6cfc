#include "libskel/cutout/skirted_legs.h"

#include <algorithm>
#include <array>

#include "libskel/cutout/limb_plane.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

constexpr double kBelowHip = 0.5;                    // of the thigh
constexpr double kAcross = 0.18;                     // of a bone: standard deviation along it
constexpr double kSmooth = 0.012, kSmoothLeg = 0.5;  // of the figure's long side, of the leg's width

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

// Gives each pixel of a leg and of the skirt to which of the two has more about it: nets leave teeth and
// dashes along hems. `limbs`: not 0 on limbs.
void smoothHem(const DrawnFigure& figure, std::uint8_t leg, double reach_px, Plane8& limbs) {
  const Plane8 &part = figure.layers.part, &mask = figure.silhouette.mask;
  const auto reach = int(std::lround(reach_px));
  const auto rows = int(mask.rows()), columns = int(mask.cols());
  // How many more pixels are the leg's than the skirt's, of all above and left of a corner.
  Eigen::ArrayXXi more = Eigen::ArrayXXi::Zero(rows + 1, columns + 1);
  const auto isSkirt = [&](int y, int x) {
    return mask(y, x) != 0 && limbs(y, x) == 0 && part(y, x) == std::uint8_t(Part::kSkirt);
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      more(y + 1, x + 1) = more(y, x + 1) + more(y + 1, x) - more(y, x) +
                           (limbs(y, x) == leg ? 1
                            : isSkirt(y, x)    ? -1
                                               : 0);
  Plane8 smooth = limbs;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      if (limbs(y, x) != leg && !isSkirt(y, x)) continue;
      const int y0 = std::max(0, y - reach), y1 = std::min(rows, y + reach + 1);
      const int x0 = std::max(0, x - reach), x1 = std::min(columns, x + reach + 1);
      const int here = more(y1, x1) - more(y0, x1) - more(y1, x0) + more(y0, x0);
      if (here != 0) smooth(y, x) = here > 0 ? leg : std::uint8_t(0);
    }
  limbs = std::move(smooth);
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
  const PixelBox box = figureBox(mask);
  for (const int leg : legs) {
    const double width =
        double((limbs == std::uint8_t(leg)).count()) / limbBones(figure, std::size_t(leg)).length();
    smoothHem(figure, std::uint8_t(leg),
              std::min(kSmooth * std::max(box.width(), box.height()), kSmoothLeg * width), limbs);
  }
  layers.limb = std::move(limbs);
  for (const int leg : legs)
    if (std::count(layers.far.begin(), layers.far.end(), leg) == 0) layers.far.push_back(leg);
  return layers;
}

}  // namespace skel
