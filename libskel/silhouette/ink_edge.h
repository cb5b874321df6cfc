// Where exactly a figure ends, in the picture's own pixels.
#pragma once

#include "libskel/image/image.h"

namespace cv {
class Mat;
}

namespace skel {

// A figure that was found in a smaller picture reaches a little beyond its ink. Takes off up to `reach`
// layers of its outer pixels that look like what is outside beside them, down to half the contrast of the ink
// they lie before; where no ink is near, nothing is taken off. `figure`: 8-bit, 255 inside, of the image's
// size. Of pictures larger than 4096 px an edge is known to as many: they are looked at in that size.
void trimToInk(const Image& image, int reach, cv::Mat& figure);

}  // namespace skel
