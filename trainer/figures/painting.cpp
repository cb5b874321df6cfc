#include "trainer/figures/painting.h"

#include <algorithm>

namespace skel {

Colour randomColour(Rng& rng, double low, double high) {
  const double base = rng.uniform(low, high);
  Colour c;
  for (auto& v : c) v = static_cast<std::uint8_t>(std::clamp(base + rng.normal(0, 35), 15.0, 250.0));
  return c;
}

Ink partInk(Style style, const Colour& fill, const Colour& rim, double rim_width) {
  Ink ink;
  ink.fill = fill;
  ink.rim = rim;
  ink.rim_width = rim_width;
  ink.hollow = style == Style::kHollow;
  return ink;
}

Ink detail(const Colour& fill) {
  Ink ink;
  ink.fill = fill;
  ink.inside_only = true;
  return ink;
}

}  // namespace skel
