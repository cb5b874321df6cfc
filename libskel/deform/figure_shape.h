// What motions must know of the flesh around the bones.
#pragma once

#include "libskel/animation/retarget.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// From a mesh in its rest pose. A biped counts as seen from the side when both feet point the same way and
// its shoulders and hips are narrow.
FigureShape measureFigure(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                          const Skeleton& skeleton);

}  // namespace skel
