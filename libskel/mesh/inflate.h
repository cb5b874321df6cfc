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
                          // that the mesh has about 3,500 vertices, whatever the figure's shape
  double thickness = 1;   // 1: a long limb 1.12 times as thick as wide, a disc 0.79 times
  int max_texture_px = 2048;  // each side of the texture
};

// Front and back, with the drawing (its colours bled outwards over the outline) as the texture of both, seen
// from the front. Soles at y = 0, x and z centred, kModelHeight_m high. Closed, 2-manifold, in one part; its
// outline lies within one cell (at least one image px) of the figure's. `silhouette` must be found and belong
// to `image`. Throws UsageError if the cell would give more than kMaxInflatedVertices.
TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options = {});

inline constexpr int kMaxInflatedVertices = 1'000'000;

}  // namespace skel
