// What a person has placed is sure.
#pragma once

#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// Says of the joints with these indices that a person has placed them. `confidence` is the chance that all
// joints are right; returns what it is now. Its doubt is shared out among the joints that do not follow from
// others by the logarithms of their own confidences, as if each were right or wrong by itself: the share of
// placed ones is gone. 1 where no doubt is left in any joint.
double markPlaced(Skeleton& skeleton, const std::vector<int>& placed, double confidence);

// Whether a person has placed all joints that do not follow from others.
bool allPlaced(const Skeleton& skeleton);

}  // namespace skel
