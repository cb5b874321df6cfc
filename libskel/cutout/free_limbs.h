// Inside the room: which limbs need no sheet of their own.
#pragma once

#include "libskel/cutout/cut_out.h"

namespace skel {

// Layers of the figure without the limbs that touch the rest of it about their roots alone, hold nothing and
// lie behind nothing: as parts of the trunk's sheet they bend at the root, and its outline stays closed
// there, which a cut would open.
LayerMap withoutFreeLimbs(const DrawnFigure& figure, LayerMap layers);

}  // namespace skel
