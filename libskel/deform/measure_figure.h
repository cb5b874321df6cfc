// What motions must know of the flesh around the bones.
#pragma once

#include <optional>

#include "libskel/animation/figure_shape.h"
#include "libskel/skeleton/facing.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// From the mesh in its rest pose. `facing`: which way it looks; nothing: to the viewer, of an animal as its
// bones tell.
FigureShape measureFigure(const TriangleMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton,
                          const std::optional<Facing>& facing = {});

}  // namespace skel
