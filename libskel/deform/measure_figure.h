// What motions must know of the flesh around the bones.
#pragma once

#include "libskel/animation/figure_shape.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// From the mesh in its rest pose.
FigureShape measureFigure(const TriangleMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton);
// FigureShape::yaw_rad alone.
double figureYaw(const TriangleMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton);

}  // namespace skel
