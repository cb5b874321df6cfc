// What paints on a mask: a round brush, and a bucket.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libskel/image/image.h"

namespace skel {

// Sets all pixels whose centre is at most `radius_px` (or half a pixel) from the line between two image
// points. Returns whether any pixel changed.
bool paintLine(Plane8& mask, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_px,
               std::uint8_t value);

// Sets the connected area of the image around `at` that looks like what lies there, and the blend of colours
// along its edge. Returns whether any pixel changed; not where `at` lies outside of the image.
bool paintArea(Plane8& mask, const Image& image, const Eigen::Vector2d& at, std::uint8_t value);

}  // namespace skel
