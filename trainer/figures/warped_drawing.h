// A drawing with known joints in other proportions: heads larger, legs shorter, bent a little.
#pragma once

#include <cstdint>
#include <vector>

#include "libskel/core/rng.h"
#include "trainer/figures/figure.h"
#include "trainer/figures/scene.h"

namespace skel {

struct WarpedDrawing {
  int width = 0, height = 0;
  std::vector<std::uint8_t> solid;      // 1 on the figure, row by row
  std::vector<Colour> colours;          // over white, row by row
  std::vector<Eigen::Vector2d> joints;  // px, corner of the first px at 0
};

// A random smooth warp, then turned by `turn` (radians, from +x towards +y). The long side is about
// `long_side` px, with a margin of `margin` px around it.
WarpedDrawing warpedDrawing(Rng& rng, const SmallDrawing& drawing, double turn, int long_side, int margin);

}  // namespace skel
