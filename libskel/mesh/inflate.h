// Stage 6: a solid body from a silhouette.
//
// L. Feng, X. Yang et al., "MagicToon" (2017): height z = sqrt(u), −Δu = const on the silhouette, u = 0 on
// its outline, scaled so that a limb comes out about as thick as it is wide.
#pragma once

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

struct InflateOptions {
  double spacing_px = 0;  // mesh grid cell in working-grid px (the figure's long side is 128); 0: chosen so
                          // that the mesh has about 2,000 to 5,000 vertices
  double thickness = 1;  // 1: limbs as thick as they are wide
};

// Front and back, with the drawing (its colours bled outwards over the outline) as the texture of both. Soles
// at y = 0, x and z centred, kModelHeight_m high. `silhouette` must be found and belong to `image`.
TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options = {});

}  // namespace skel
