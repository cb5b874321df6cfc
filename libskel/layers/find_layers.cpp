#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "libskel/layers/find_limbs.h"
#include "libskel/layers/held_things.h"
#include "libskel/layers/layer_map.h"
#include "libskel/layers/limb_net.h"
#include "libskel/layers/linked_hands.h"

namespace skel {
namespace {

constexpr double kDrawn = .55;  // of a limb's border against the rest
constexpr double kGrown = .4;   // of a limb's border against the body: it is hidden where it is a guess
constexpr double kSeen = .25;   // of an arm's bones beyond its root: of less nothing is seen
// Confidence in the end of a limb that is not hidden: as many hands of drawings that nothing was learned from
// lie below as had less than .75 of their heatmap around them (23 in 100).
constexpr double kSure = .85;

// Grown to the body all along, and nothing tells the two apart.
bool isGrown(const LimbBorder& border) {
  return border.against >= kGrown * border.all && border.drawn < kDrawn * border.against;
}

// Whether what divides the limb from the rest beyond its root is drawn, so that neither is torn.
bool isDivided(const LimbBorder& border) { return border.beside_drawn >= kDrawn * border.beside; }

// What lies before the trunk is nearer than what it hides.
std::vector<int> farLimbs(const SkeletonTemplate& body_plan, const std::array<double, 4>& before) {
  std::vector<int> far;
  if (!body_plan.from_side) return far;
  for (const auto& [a, b] : body_plan.limbPairs())
    far.push_back(1 + (before[std::size_t(b)] > before[std::size_t(a)] ? a : b));
  return far;
}

// To the image's size, borders as smooth as its pixels allow: of each pixel of `mask` the number that most of
// its neighbours in `small` have, nearer ones more.
Plane8 enlarged(const PartPicture& picture, const Plane8& small, const Plane8& mask) {
  Plane8 whole = Plane8::Zero(mask.rows(), mask.cols());
  const PixelBox& box = picture.box;
  struct Between {
    int first, second;
    double share;  // of the second
  };
  const auto between = [&](int at, int count) {
    const double u = (at + .5) * picture.scale - .5, first = std::floor(u);
    const auto clamped = [&](double k) { return static_cast<int>(std::clamp(k, 0., count - 1.)); };
    return Between{clamped(first), clamped(first + 1), u - first};
  };
  std::vector<Between> columns;
  for (int x = 0; x < box.width(); ++x) columns.push_back(between(x, small.cols()));
  for (int y = 0; y < box.height(); ++y) {
    const Between row = between(y, small.rows());
    const std::uint8_t *upper = small.row(row.first).data(), *lower = small.row(row.second).data();
    std::uint8_t* out = &whole(y + box.y0, box.x0);
    for (int x = 0; x < box.width(); ++x) {
      if (mask(y + box.y0, x + box.x0) == 0) continue;
      const Between& column = columns[static_cast<std::size_t>(x)];
      const std::array<std::uint8_t, 4> value = {upper[column.first], upper[column.second],
                                                 lower[column.first], lower[column.second]};
      out[x] = value[0];
      if (value[0] == value[1] && value[0] == value[2] && value[0] == value[3]) continue;
      const double v = row.share, u = column.share;
      const std::array<double, 4> weight = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
      double most = -1;
      for (std::size_t i = 0; i < 4; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < 4; ++j) sum += value[j] == value[i] ? weight[j] : 0;
        if (sum > most) most = sum, out[x] = value[i];
      }
    }
  }
  return whole;
}

}  // namespace

LayerMap findLayers(const Image& image, const Silhouette& silhouette, const Skeleton& skeleton,
                    const SkeletonTemplate& body_plan, const PartNet& net) {
  LayerMap map;
  const std::optional<FoundLimbs> found = findLimbs(image, silhouette, skeleton, body_plan, net);
  if (!found) return map;
  const PartPicture& picture = found->picture;
  map.far = farLimbs(body_plan, picture.before);
  map.hands_linked = !found->skeleton.animal && areHandsLinked(picture, found->skeleton);
  Plane8 limbs = Plane8::Zero(picture.part.rows(), picture.part.cols());
  for (int k = 0; k < 4; ++k) {
    if (map.hands_linked && body_plan.limbs[static_cast<std::size_t>(k)].limb_class == JointClass::kHand) {
      map.hidden.push_back(k + 1);
      continue;
    }
    const LimbBorder& border = found->borders[static_cast<std::size_t>(k)];
    if (liesAgainst(border) && isDivided(border) &&
        builtInLimbNet().isLimb(limbEvidence(*found, k)) >= kIsLimb) {
      limbs =
          (picture.part == static_cast<std::uint8_t>(limbPart(k)))
              .select(Plane8::Constant(limbs.rows(), limbs.cols(), static_cast<std::uint8_t>(k + 1)), limbs);
      continue;
    }
    const TemplateLimb& limb = body_plan.limbs[static_cast<std::size_t>(k)];
    const int end = skeleton.find(body_plan.joints[static_cast<std::size_t>(limb.joints[2])].name);
    if (limb.limb_class == JointClass::kHand &&
        skeleton.joints[static_cast<std::size_t>(end)].confidence < kSure &&
        (seenOf(picture, found->skeleton, k) < kSeen || isGrown(border)))
      map.hidden.push_back(k + 1);
  }
  map.part = enlarged(picture, picture.part, silhouette.mask);
  completeThings(silhouette.mask, map.part);
  if ((limbs == 0).all()) return map;
  map.limb = enlarged(picture, limbs, silhouette.mask);
  giveThingsToLimbs(silhouette, map);
  return map;
}

}  // namespace skel
