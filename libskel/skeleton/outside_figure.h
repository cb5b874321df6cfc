// Whether a skeleton belongs to a figure at all.
#pragma once

#include "libskel/image/image.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// The first joint that lies further from the figure in `mask` (any pixel > 0) than a fifth of the figure's
// long side; null if there is none. Hands and heads may be placed a little outside, never that far.
const Joint* jointFarOutside(const Skeleton& skeleton, const Plane8& mask);

}  // namespace skel
