// A picture of every stage, for people who want to see what happened.
#pragma once

#include <string>

#include "libskel/pipeline/rig_character.h"
#include "libskel/silhouette/steps.h"

namespace skel {

// Writes dir/1-drawing.png … 8-posed.png, sides.png and summary.png. Where the step was needed also
// 2-sheet.png, 2-unruled.png and 2-page-net.png (`steps`: none if the mask was given), 2-pieces.png,
// 6-layers.png; else these are removed. `drawing` must be found. Throws OutputError.
void writeTrace(const RiggedDrawing& drawing, const SilhouetteSteps& steps, const std::string& dir);

}  // namespace skel
