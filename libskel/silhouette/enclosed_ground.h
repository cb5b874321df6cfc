// Ground that may be in a mask, since lines of the figure enclose it.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "libskel/image/image.h"

namespace skel {

struct EnclosedGround {
  double share = 0;    // of the mask, that is expected to be ground
  Eigen::Array4d box;  // of the piece with the most of it, px of the picture: x, y, width, height
};

// `mask`: 255 on the figure, of the picture. `chance`: that a px is ground that lines enclose, of 255; the
// picture, made smaller. Nothing where there is none in the mask.
std::optional<EnclosedGround> enclosedGround(const Plane8& mask, const Plane8& chance);

}  // namespace skel
