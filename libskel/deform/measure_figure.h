// What motions must know of the flesh around the bones.
#pragma once

#include <optional>

#include "libskel/animation/figure_shape.h"
#include "libskel/skeleton/facing.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// From the mesh in its rest pose. `facing`: which way it looks, where that is known; nothing: as facingOf()
// says.
FigureShape measureFigure(const TriangleMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton,
                          const std::optional<Facing>& facing = {});
// Of somebody on two legs, by the net; nothing for others.
std::optional<Facing> facingOf(const TriangleMesh& mesh, const SkinWeights& weights,
                               const Skeleton& skeleton);

}  // namespace skel
