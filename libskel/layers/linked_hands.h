// Both hands on one thing, a barbell, a rope, a book, a flute, or on each other.
#pragma once

#include "libskel/layers/find_parts.h"

namespace skel {

// Whether the hands, with what they hold, are in one piece, so that an arm that moved by itself would break
// it. `skeleton`: of people, in image px, the corner of the first at 0.
bool areHandsLinked(const PartPicture& picture, const PartSkeleton& skeleton);

}  // namespace skel
