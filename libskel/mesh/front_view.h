// A model of the user's own, seen from the front: how a drawing lies on it.
#pragma once

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

struct FrontView {
  Plane8 mask;                      // 255 where the model is
  ModelFromImage model_from_image;  // image px are those of mask
};

// What a viewer at +z sees of the mesh, its longer side `size_px` long, with a border of 2 px. Thin parts
// cover at least the pixels that their vertices and edges pass. `mesh` has triangles and is not flat as seen
// from the front.
FrontView frontSilhouette(const TriangleMesh& mesh, int size_px = 512);

// The bounding box of the figure in `mask` (any pixel > 0) onto that of the mesh as seen from the front (Shu
// & Yang 2018); the scales across and down may differ.
ModelFromImage bindByBoundingBox(const Plane8& mask, const TriangleMesh& mesh);

// Moved and scaled to the model frame: soles at y = 0, x and z centred, kModelHeight_m high. The vertices
// alone; model_from_image stays.
void standUpright(TriangleMesh& mesh);

}  // namespace skel
