// From a mask at the picture's size to the small grid that the geometry works on.
#pragma once

#include "libskel/silhouette/silhouette.h"

namespace skel {

// The grid over the box of the mask's figure, which must not be empty.
WorkingGrid gridOver(const Plane8& mask);

// A grid pixel is figure if the mask covers at least half of it; where that would tear the figure or lose a
// thin limb, the best covered pixels keep it whole. The result is one 4-connected figure if `mask` is.
Plane8 sampleMask(const Plane8& mask, const WorkingGrid& grid);

}  // namespace skel
