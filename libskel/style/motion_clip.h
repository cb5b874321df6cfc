// A motion in the picture as a clip for the 3D character.
#pragma once

#include <string>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/style/poses.h"

namespace skel {

// For the canonical pose, in the plane of the picture: retargetToRest() makes each drawn bone point where the
// motion's does. `times_s`: of the frames. `loops`: a last key that is the first, a frame after the last one.
// The root goes as the motion's does, in heights of its figure.
Clip clipOfMotion(const PoseMatrix& motion, const std::vector<double>& times_s, bool loops,
                  const SkeletonTemplate& body_plan, const std::string& name);

}  // namespace skel
