// A rigged drawing that moves as it was drawn: cut out, in the picture plane.
#pragma once

#include "libskel/cutout/cut_out.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// Arms that are one piece with the body in the model, or that it does not move since they would tear it, are
// parts of the trunk here, too. The drawing must be found.
CutOut cutOutOf(const RiggedDrawing& drawing);

// Its pose in a clip; `clip` is one of the drawing's, or made for its rest pose.
FlatPose flatPoseAt(const RiggedDrawing& drawing, const Clip& clip, double time_s);

}  // namespace skel
