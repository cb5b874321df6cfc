// Random masks of every awkward kind.
#pragma once

#include <algorithm>
#include <cmath>

#include "libskel/core/rng.h"
#include "libskel/image/image.h"

namespace skel {

// Blobs, holes, hairlines, one-pixel bridges, combs, corners that touch, noise; up to max_size px a side. Not
// yet cleaned: in any number of parts, perhaps empty.
inline Plane8 randomSilhouette(Rng& rng, int max_size = 96) {
  const int width = 1 + static_cast<int>(rng.below(max_size)),
            height = 1 + static_cast<int>(rng.below(max_size));
  Plane8 mask = Plane8::Zero(height, width);
  const auto disc = [&](double cx, double cy, double radius, std::uint8_t value) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (std::hypot(x - cx, y - cy) <= radius) mask(y, x) = value;
      }
    }
  };
  const auto line = [&](double x0, double y0, double x1, double y1) {
    const int steps = 2 * std::max(width, height);
    for (int s = 0; s <= steps; ++s) {
      const int x = static_cast<int>(x0 + (x1 - x0) * s / steps),
                y = static_cast<int>(y0 + (y1 - y0) * s / steps);
      mask(std::clamp(y, 0, height - 1), std::clamp(x, 0, width - 1)) = 255;
    }
  };
  const auto px = [&] { return rng.uniform(0, width); };
  const auto py = [&] { return rng.uniform(0, height); };
  for (int part = 1 + static_cast<int>(rng.below(5)); part > 0; --part) {
    switch (rng.below(8)) {
      case 0:
      case 1:
        disc(px(), py(), rng.uniform(0.5, 0.4 * std::max(width, height)), 255);
        break;
      case 2:  // holes, down to one pixel
        disc(px(), py(), rng.uniform(0, 0.15 * std::max(width, height)), 0);
        break;
      case 3:  // hairlines and bridges
        line(px(), py(), px(), py());
        break;
      case 4: {  // a comb
        const int y0 = static_cast<int>(py()), tooth = 1 + static_cast<int>(rng.below(4));
        mask.row(y0).setConstant(255);
        for (int x = 0; x < width; ++x) {
          if (x / tooth % 2 == 0) mask.col(x).segment(y0, height - y0).setConstant(255);
        }
        break;
      }
      case 5: {  // a chessboard: corners touch
        const int x0 = static_cast<int>(px()), y0 = static_cast<int>(py()),
                  square = 1 + static_cast<int>(rng.below(3));
        for (int y = y0; y < std::min(height, y0 + 12); ++y) {
          for (int x = x0; x < std::min(width, x0 + 12); ++x)
            mask(y, x) = (x / square + y / square) % 2 ? 255 : 0;
        }
        break;
      }
      case 6:  // noise
        for (int n = static_cast<int>(rng.below(width * height / 4 + 1)); n > 0; --n) {
          mask(static_cast<int>(py()), static_cast<int>(px())) = rng.chance(0.5) ? 255 : 0;
        }
        break;
      default: {
        const int x0 = static_cast<int>(px()), y0 = static_cast<int>(py());
        mask.block(y0, x0, 1 + rng.below(height - y0), 1 + rng.below(width - x0)).setConstant(255);
      }
    }
  }
  return mask;
}

}  // namespace skel
