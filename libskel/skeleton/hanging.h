// Joints of what hangs on a figure: a skirt, a cape, a tail, hair. No motion names them: they follow those
// that carry them (animation/follow_through.h).
#pragma once

#include <string>
#include <string_view>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// "hanging_skirt_1": of the chain `what`, the `link`-th joint from where it hangs, from 1 on.
std::string hangingJointName(const std::string& what, int link);
bool isHangingName(std::string_view joint);
bool hangs(const Joint& joint);

// The joint that it hangs on, through all of its chain; `joint` itself if it does not hang.
int carrierOf(const Skeleton& skeleton, int joint);

// Those of the body plan alone. No joint that stays hangs on one that does not.
Skeleton withoutHanging(const Skeleton& skeleton);

}  // namespace skel
