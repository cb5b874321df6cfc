// What a figure encloses.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// Makes it the figure's, 255.
void fillHoles(Plane8& mask);

}  // namespace skel
