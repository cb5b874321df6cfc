// Arms that are folded so far that forearm and upper arm cover the same of the picture.
#pragma once

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// Which flesh is the forearm's and which the upper arm's cannot be told there: all of it goes with the upper
// arm, so that nothing comes off when the elbow turns.
void foldArms(const Skeleton& skeleton, const SkeletonTemplate& body_plan, SkinWeights& weights);

}  // namespace skel
