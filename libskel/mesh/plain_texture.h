// A texture of one colour.
#pragma once

#include <array>

#include "libskel/image/image.h"

namespace skel {

inline Image plainTexture(const std::array<std::uint8_t, 3>& rgb) {
  Image texture(4, 4);
  for (Eigen::Index i = 0; i < texture.rgba.rows(); ++i) texture.rgba.row(i) << rgb[0], rgb[1], rgb[2], 255;
  return texture;
}

}  // namespace skel
