// A figure of known parts in another pose: its limbs are cut out, turned, and laid back before the body or
// behind it. Arms across the body are what drawings by others have and posed dolls have not.
#pragma once

#include "libskel/core/rng.h"
#include "trainer/part_samples.h"

namespace skel {

// Limbs turn in root and middle joint and take along what is held at their end; what was hidden behind them
// gets the colours and parts that lie nearest. The result is the figure's new box.
PartSample posedPartSample(Rng& rng, const PartSample& sample);

}  // namespace skel
