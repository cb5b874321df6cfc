// Line art on a clear ground: the figure is what its lines enclose, as if they were drawn on paper.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// Whether hardly more than lines is opaque, or half as much again is enclosed by it. `opaque`: 255 on what is
// drawn.
bool mayBeLineArt(const Plane8& opaque);

// Laid on white, light lines on dark grey.
Image laidOnPaper(Image image);

// Whether so much of the figure cannot be seen, only its lines, that there must be paper under it. `image`:
// of the mask's size.
bool needsPaper(const Image& image, const Plane8& mask);

}  // namespace skel
