// What hangs on a figure moves a little behind it.
#pragma once

#include <vector>

#include "libskel/animation/plant_feet.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

inline constexpr double kMostHanging_rad = 0.35;

// Turns the joints that hang (skeleton/hanging.h), each a damped pendulum on a spring about what carries it:
// it lags when that is moved or turned, swings through, and settles; one that hangs down keeps to the
// vertical where the body leans. None turns by more than kMostHanging_rad, and less to the viewer and away
// than in the picture, so that a skirt does not go through its legs. `poses`: even moments; a motion whose
// end is its beginning stays one. Where ModelPose::share is 0 nothing is turned.
void followThrough(const Skeleton& skeleton, std::vector<ModelPose>& poses);

}  // namespace skel
