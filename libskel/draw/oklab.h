// B. Ottosson, "A perceptual color space for image processing" (2020): distances in it are about as large as
// colours look different.
#pragma once

#include <Eigen/Core>

#include "libskel/draw/color.h"

namespace skel {

// Lightness 0…1, green to red, blue to yellow.
Eigen::Vector3f oklabFromSrgb(Color color);
// The nearest colour that sRGB has, opaque.
Color srgbFromOklab(const Eigen::Vector3f& lab);

}  // namespace skel
