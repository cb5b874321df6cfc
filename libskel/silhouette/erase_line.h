// A printed line of the paper, in the picture's own pixels.
#pragma once

#include <Eigen/Core>

#include "libskel/image/image.h"
#include "libskel/silhouette/ruling.h"

namespace skel {

// Takes the line off what lies in `box` (x, y, width, height). Ink over it, which is darker than the line
// makes paper, stays; what covers the line stays, too: nothing becomes lighter than what is on both sides of
// it, nor by more than it darkens bare paper, which is seen beside the figure (`figure`: not 0 there). False
// if it is not seen there. `line_px`: how exactly its place is known, image px.
bool eraseLine(const RuledLine& line, const Plane8& figure, const Eigen::Array4i& box, double line_px,
               Image& image);

}  // namespace skel
