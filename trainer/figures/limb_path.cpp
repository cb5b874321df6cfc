#include "trainer/figures/limb_path.h"

#include <algorithm>
#include <numbers>

namespace skel {

using Vec = Eigen::Vector2d;

LimbPath limbPath(const LimbPlan& limb) {
  const Vec &a = limb.root, &b = limb.middle, &c = limb.end;
  const Vec control = 2 * b - .5 * (a + c);
  const Vec n = leftOf(normalised(c - a));
  LimbPath path;
  for (int i = 0; i < kLimbPoints; ++i) {
    const double t = i / (kLimbPoints - 1.0);
    const Vec sharp = t <= .5 ? Vec(a + (b - a) * 2 * t) : Vec(b + (c - b) * (2 * t - 1));
    const Vec round = (1 - t) * (1 - t) * a + 2 * t * (1 - t) * control + t * t * c;
    path[i] = sharp + (round - sharp) * limb.rubber + n * limb.wave * std::sin(2 * std::numbers::pi * t);
  }
  return path;
}

LimbPath flowing(const Vec& a, const Vec& b, const Vec& c) { return limbPath({a, b, c, 1, 0, true, false}); }

LimbRadii radiiThrough(double start, double middle, double end) {
  LimbRadii radii;
  for (int i = 0; i < kLimbPoints; ++i) {
    const double t = i / (kLimbPoints - 1.0);
    radii[i] = std::max(kThinnest,
                        t < .5 ? start + (middle - start) * 2 * t : middle + (end - middle) * (2 * t - 1));
  }
  return radii;
}

}  // namespace skel
