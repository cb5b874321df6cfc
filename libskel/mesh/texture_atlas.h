// Several textures side by side in one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// A texture, and the texture coordinates that are asked of it: beyond [0, 1] it repeats.
struct AtlasTile {
  Image image;  // not empty
  Eigen::Array2f low = Eigen::Array2f::Zero(), high = Eigen::Array2f::Ones();
};

struct TextureAtlas {
  Image image;
  // Texture coordinates of tile k become scale[k]·uv + offset[k].
  std::vector<Eigen::Array2f> scale, offset;
};

// Tiles in rows, the tallest first, each as often as it repeats, with its rim drawn out by kAtlasRim px
// against bleeding. No pixels are scaled. Empty image: they need more than kMaxAtlas_px a side.
TextureAtlas packAtlas(const std::vector<AtlasTile>& tiles);

inline constexpr int kAtlasRim = 2, kMaxAtlas_px = 8192;

}  // namespace skel
