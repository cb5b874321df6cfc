// A picture of every stage, for people who want to see what happened.
#pragma once

#include <string>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// Writes dir/1-drawing.png … 8-posed.png, sides.png and summary.png; 6-layers.png if there are layers.
// `drawing` must be found. Throws OutputError.
void writeTrace(const RiggedDrawing& drawing, const std::string& dir);

}  // namespace skel
