// Flat textured triangles, as those of a cut-out figure.
#pragma once

#include <Eigen/Core>

#include "libskel/image/image.h"

namespace skel {

// Paints the triangles one over another in their order, with the opaque colours of `texture`, each pixel from
// 2×2 samples; what is around the figure shows through. `places`: #V×2, image px of `image`;
// `texture_places`: #V×2, px of the texture, clamped to it.
void drawTriangles(Image& image, const Eigen::MatrixX2d& places, const Eigen::MatrixX3i& triangles,
                   const Image& texture, const Eigen::MatrixX2d& texture_places);

}  // namespace skel
