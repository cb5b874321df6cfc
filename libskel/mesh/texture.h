// The drawing as a texture.
#pragma once

#include <Eigen/Core>

#include "libskel/image/image.h"
#include "libskel/mesh/outline.h"

namespace skel {

inline constexpr int kTextureMargin = 4;  // texels around the figure's box

struct DrawingTexture {
  Image image;    // opaque
  Plane8 figure;  // of its size, 1 where a texel shows the figure
  // Image px to glTF texture coordinates.
  Eigen::Vector2d corner_px;  // of the texture's top left pixel, image px
  Eigen::Vector2d size_px;    // of the whole texture, image px
  Eigen::Vector2d uvFromImage(const Eigen::Vector2d& p) const {
    return (p - corner_px).cwiseQuotient(size_px);
  }
};

// The part of the drawing around the figure, at most `max_size` texels a side. Only the figure's own colours
// are in it: from the outline outwards, and where the figure is transparent, they are bled (pull-push).
DrawingTexture drawingTexture(const Image& image, const Plane8& mask, const PixelBox& box, int max_size);

}  // namespace skel
