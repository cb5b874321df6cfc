// A round brush on a mask.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libskel/image/image.h"

namespace skel {

// Sets all pixels whose centre is at most `radius_px` (or half a pixel) from the line between two image
// points. Returns whether any pixel changed.
bool paintLine(Plane8& mask, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_px,
               std::uint8_t value);

}  // namespace skel
