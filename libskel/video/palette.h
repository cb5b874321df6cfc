// Few colours for a picture of many.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace skel {

using Rgb = std::array<std::uint8_t, 3>;

// At most `max_colors` (1…256) colours that stand for those of the pixels, and for each pixel the index of
// its colour.
struct Palette {
  std::vector<Rgb> colors;
  std::vector<std::uint8_t> indices;
};
Palette choosePalette(const std::vector<Rgb>& pixels, int max_colors);

}  // namespace skel
