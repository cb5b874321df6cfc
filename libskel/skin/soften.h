// Weights that bend without creases.
#pragma once

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/falloff.h"

namespace skel {

// Scales rows to a sum of 1, then spreads weights along the mesh until (within a number of sweeps) no short
// edge sees a large change, and no triangle turns inside out when the joint in the middle of a limb is bent
// by 90°.
void softenWeights(const TriangleMesh& mesh, const Skeleton& skeleton, JointWeights& weights);

}  // namespace skel
