// Inside the room: what of a figure is bare paper.
#pragma once

#include "libskel/image/image.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

// The drawing with the paper between the figure's outermost lines and the edge of its silhouette taken off:
// on a thin limb it is as wide as the line, and hides what the limb passes before. Alpha and colour of the
// pixels that are half line are what the line alone has there. Nothing is taken off where the ground about
// the figure is not of one colour.
Image withoutPaperRim(Image image, const Silhouette& silhouette);

}  // namespace skel
