// The figure's outline as smooth closed curves.
#pragma once

#include "libskel/silhouette/silhouette.h"

namespace skel {

// Pixels of a mask that hold the figure: columns [x0, x1), rows [y0, y1); empty when x0 == x1.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};
PixelBox figureBox(const Plane8& mask);

// The middles of the sides of pixels that a polygon of pixel corners runs along, in order: points about one
// px apart that cut the corners off.
Polygon sideMiddles(const Polygon& corners);

// Takes the stairs out of such a curve: each point becomes the (twice) box-filtered mean of the points up to
// `radius` before and after it, moved by at most `limit_px`.
void smoothOutline(Polygon& curve, int radius, double limit_px);

}  // namespace skel
