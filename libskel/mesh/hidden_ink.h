// Lines about what a piece of a figure had hidden by another piece.
#pragma once

#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/outline.h"

namespace skel {

// `hidden` and the dark lines beside it, up to `reach_px` away: what is left of the outline of that which
// hides, and would run into what is filled (fillHidden()). Planes of the image's size; `known`: not 0 on the
// piece.
Plane8 withLeftInk(const Image& image, const Plane8& known, const Plane8& hidden, int reach_px);

// Draws the outline on where the rim was hidden: as wide as it is drawn elsewhere (the median), in the colour
// of the nearest of it along the rim. Nothing where less than half of the rest of the rim has one. `mask`,
// `hidden`: of the image's size, not 0 on the piece and where another hid it; `outline`: closed curves around
// `mask` (drawnOutline()).
void inkHiddenRim(const Plane8& mask, const Plane8& hidden,
                  const std::vector<std::vector<Eigen::Vector2d>>& outline, Image& image);

}  // namespace skel
