// A larger joint net that begins where a smaller one has come to.
#pragma once

#include "libskel/core/rng.h"
#include "libskel/jointnet/joint_net.h"

namespace skel {

// `net` with further hourglasses behind its own, which change nothing yet: the same heatmaps to the last bit.
// They are residual to the map that they begin from, and what they add to it is zero at first, as in Goyal et
// al., "Accurate, large minibatch SGD" (2017), section 5.1. `hourglasses`: no fewer than the net has.
JointNet grown(const JointNet& net, int hourglasses, Rng& rng);

}  // namespace skel
