// Limbs that are bodies of their own hang on the trunk as on one skin.
#pragma once

#include <vector>

#include "libskel/layers/layer_map.h"
#include "libskel/mesh/figure_piece.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/template.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// What a limb's piece shares with the trunk about its first joint, since the drawing shows the trunk there,
// stays with the trunk; from there on, over half of the limb's width, the limb goes over to its own bones: a
// shoulder or a waist stretches as one skin does, and neither stands out nor gapes. Limbs that lie behind the
// trunk hang as they are: it hides their roots. `skeleton` is lifted into the mesh (m).
void tieLimbRoots(const TriangleMesh& mesh, const SkeletonTemplate& body_plan,
                  const std::vector<FigurePiece>& pieces, const LayerMap& layers, const Skeleton& skeleton,
                  SkinWeights& weights);

}  // namespace skel
