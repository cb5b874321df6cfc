// Weights that bend without creases.
#pragma once

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/falloff.h"

namespace skel {

// Rows that sum to 1 with at most `max_influences` weights above 0, and, as far as the mesh lets them:
// - no edge sees a change above 0.35, unless the mesh is coarse;
// - no triangle turns inside out when the joint in the middle of a limb is bent by 90°, to either side,
// forwards
//   or backwards. Where a limb is drawn over the trunk, it gives way;
// - limbs that touch share hardly any weight: what lies between them goes with the trunk.
void softenWeights(const TriangleMesh& mesh, const Skeleton& skeleton, int max_influences,
                   JointWeights& weights);

// Where two limbs share a vertex, what the weaker has goes, from both, to the trunk that they hang on.
void partLimbs(const Skeleton& skeleton, const std::vector<int>& limbs, JointWeights& weights);

}  // namespace skel
