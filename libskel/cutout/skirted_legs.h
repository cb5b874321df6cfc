// Inside the room: which legs come out from under a skirt.
#pragma once

#include "libskel/cutout/cut_out.h"

namespace skel {

// The figure's layers, with its legs as far limbs of their own if they come out from under a skirt or coat:
// they swing behind the hem, which stays whole. That is so where each touches more of it than of the trunk,
// half of a thigh below the hip at least (shorts and shirts end above), and across alone (capes hang along).
LayerMap withSkirtedLegs(const DrawnFigure& figure);

}  // namespace skel
