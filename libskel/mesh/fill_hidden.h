// What a drawing does not show because something is drawn over it.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// The picture with the pixels of `hidden` (of its size, not 0 there) painted from those of `known` (likewise)
// around them, nearest first. Pixels that nothing known reaches stay.
Image fillHidden(Image image, const Plane8& known, const Plane8& hidden);

}  // namespace skel
