// The boundary between pixels as polygons.
#pragma once

#include <vector>

#include "libskel/silhouette/silhouette.h"

namespace skel {

// Of a mask with one 4-connected figure: the outer contour first, then the holes from top to bottom. Corners
// only, so that no three neighbouring points lie on one line.
std::vector<Polygon> traceOutline(const Plane8& mask);

// From `p` to the nearest side of a polygon; infinite if there are none.
double distanceToOutline(const std::vector<Polygon>& outline, const Eigen::Vector2d& p);

}  // namespace skel
