#pragma once

#include <cstddef>
#include <vector>

#include "libskel/animation/plant_feet.h"

namespace skel {

// Which poses are keys enough for the joints to stay within `tolerance_m` of the others: from each key as far
// as that holds.
std::vector<std::size_t> keysWithin(const Skeleton& skeleton, const std::vector<ModelPose>& poses,
                                    double tolerance_m);

}  // namespace skel
