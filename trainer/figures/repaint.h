// The same figure as somebody else would have drawn it: appearances drawn at random, after Tobin et al.,
// "Domain randomization for transferring deep neural networks from simulation to the real world" (2017).
#pragma once

#include "libskel/core/rng.h"
#include "libskel/image/image.h"
#include "libskel/jointnet/figure_look.h"

namespace skel {

// Changes the colours of a figure (one row a px of `mask`, 0 to 255): another palette or lines alone,
// hatching, blotches; often nothing. Its shape stays.
void repaint(Rng& rng, const Plane8& mask, GridColours& colours);

}  // namespace skel
