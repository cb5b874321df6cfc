// Things in hands, on backs and beside hips, which drawings by others have far more often than ours: given to
// figures whose parts are known, so that the part net learns that they are neither limb nor clothes.
#pragma once

#include "libskel/core/rng.h"
#include "trainer/part_samples.h"

namespace skel {

// Gives the figure one or two things: what `other` holds, the whole of it as a doll, or sticks, balls, boxes
// and cards; before the figure, behind it, or in the hand, between arm and body. The result is the figure's
// new box.
PartSample withThings(Rng& rng, const PartSample& sample, const PartSample& other);

}  // namespace skel
