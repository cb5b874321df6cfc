// What stage 2 sees on its way, for people who want to look at it.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// Empty: the picture did not need the step.
struct SilhouetteSteps {
  Image sheet;          // straightened (page.h)
  Image unruled;        // without the ruling of the paper (ruling.h)
  Plane8 figure_share;  // how probably each pixel is figure, of 255 (page_net.h); the picture made smaller
};

// Those of extractSilhouette(image), which are none where the picture's alpha tells the figure.
SilhouetteSteps silhouetteSteps(const Image& image);

}  // namespace skel
