// Slits that run into a figure where its colour is nearly the paper's.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// Makes long narrow gaps the figure's, 255. `figure`: the figure's box alone.
void closeSlits(Plane8& figure);

}  // namespace skel
