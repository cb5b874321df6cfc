// What a person has placed is sure.
#pragma once

#include <vector>

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Says of the joints with these indices that a person has placed them. `confidence` is the chance that all
// joints are right; returns what it is now. Its doubt is shared out among the joints that do not follow from
// others by the logarithms of their own confidences, as if each were right or wrong by itself: the share of
// placed ones is gone. 1 where no doubt is left in any joint.
double markPlaced(Skeleton& skeleton, const std::vector<int>& placed, double confidence);

// Puts the joints that `body_plan` derives as midpoints half way between those that they follow (image px),
// where a person has placed one of these and nobody has placed them.
void followPlaced(Skeleton& skeleton, const SkeletonTemplate& body_plan);

// Whether a person has placed all joints that do not follow from others.
bool allPlaced(const Skeleton& skeleton);

}  // namespace skel
