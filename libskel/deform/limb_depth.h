// Limbs that lie over one another in a drawing from the side, put beside one another in depth.
#pragma once

#include <vector>

#include "libskel/skeleton/template.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// Moves one limb of each pair towards the viewer and the other away from him, by a little more
// than half of its own thickness each, as far as the figure is turned to the side: `yaw_rad` as in
// FigureShape, and always for body plans that are drawn from the side. `far`: limbs, numbered
// from 1, that are the farther ones; of a pair of which none is the nearer one is the one that was recognised
// more surely, or else the one that the template names first. Moves the joints with the flesh, so
// that the weights stay those of the same bones; from the front nothing changes. `mesh` and `weights` belong
// together.
void partLimbsInDepth(TriangleMesh& mesh, Skeleton& skeleton, const SkinWeights& weights,
                      const SkeletonTemplate& body_plan, double yaw_rad, const std::vector<int>& far = {});

}  // namespace skel
