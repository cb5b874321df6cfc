// What hangs on a figure moves a little behind it.
#pragma once

#include <vector>

#include "libskel/animation/plant_feet.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

inline constexpr double kMostHanging_rad = 0.35;

// Turns the joints that hang (skeleton/hanging.h) and that the clip does not turn itself, each a damped
// pendulum on a spring about what carries it: it lags when that is moved or turned, swings through, and
// settles; one that hangs down keeps to the vertical where the body leans, one that does not (a wing) is
// stiffer. None turns by more than kMostHanging_rad, and less to the viewer and away than in the picture, so
// that a skirt does not go through its legs. `poses`: even moments of the clip; a motion whose end is its
// beginning stays one. Where ModelPose::share is 0 nothing is turned.
void followThrough(const Skeleton& skeleton, const Clip& clip, std::vector<ModelPose>& poses);

}  // namespace skel
