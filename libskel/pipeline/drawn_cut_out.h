// A rigged drawing that moves as it was drawn: cut out, in the picture plane.
#pragma once

#include "libskel/cutout/cut_out.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// Arms that are one piece with the body in the model, or that it does not move since they would tear it, are
// parts of the trunk here, too. The drawing must be found.
CutOut cutOutOf(const RiggedDrawing& drawing);

// How far bones turn in a clip, as shares of how far they would, and the greatest share of the drawing that
// this tears (tornShare()).
struct Calm {
  double legs = 1, rest = 1, torn = 0;
};
// Of the drawing: a clip is not to tear more.
inline constexpr double kMuchTorn = 0.03;
// As far as it tears no more than that, which legs that walk do of who sits or kneels; if it does so however
// calm, the calmest.
Calm calmFor(const RiggedDrawing& drawing, const CutOut& cut_out, const Clip& clip);

// Its pose in a clip; `clip` is one of the drawing's, or made for its rest pose.
FlatPose flatPoseAt(const RiggedDrawing& drawing, const Clip& clip, double time_s, const Calm& calm = {});

}  // namespace skel
