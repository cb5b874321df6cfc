// A skinned mesh in a pose without collapsing elbows.
#pragma once

#include "libskel/deform/skin_vertices.h"

namespace skel {

// #V×3. Where a joint scales, its stretch is blended linearly, before the rigid motions are. Transforms that
// mirror count as the nearest one that does not.
Eigen::MatrixX3f blendDualQuaternions(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                                      const JointTransforms& posed_from_rest);

}  // namespace skel
