// Stage 6: a solid body from a silhouette.
//
// L. Feng, X. Yang et al., "MagicToon" (2017): height z = sqrt(u), −Δu = const on the silhouette, u = 0 on
// its outline, scaled so that a limb comes out about as thick as it is wide; by the bones, where they are
// known (body_depth.h), so that each part is as deep as such parts are.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "libskel/mesh/back_colors.h"
#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/figure_piece.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

// What the back wears.
enum class Back {
  kPlain,  // the drawing's areas of colour, without face and lines (back_colors.h)
  kSame,   // the drawing, as the front does
};

// The figure drawn from behind: its box is laid onto the front's, mirrored.
struct BackPicture {
  Image image;
  Plane8 mask;  // of the image's size, not 0 on the figure
};

struct InflateOptions {
  double spacing_px = 0;  // mesh grid cell in working-grid px (the figure's long side is 128); 0: chosen so
                          // that the mesh has about 3,500 vertices, whatever the figure's shape
  double thickness = 1;   // 1: a long limb 1.12 times as thick as wide, a disc 0.79 times; more than 0
  int max_texture_px = 2048;  // each side of the texture; kLeastMaxTexture or more
  double height_m = kModelHeight_m;
  double length_m = 0;    // of the model's longer side, up or across; 0: height_m counts instead
  double turned_rad = 0;  // how far the figure is turned clockwise in the drawing: the model stands upright
  bool thin_outline = false;  // a dark outline is a thin flange instead of a part of the round body
  BodyDepth body = {};        // what is known of its parts
  Back back = Back::kSame;
  std::optional<HeadDisc> head = std::nullopt;                // image px; for a back without a face
  std::shared_ptr<const BackPicture> back_picture = nullptr;  // if there is one, instead of `back`
};

// Front and back, with the drawing (its colours bled outwards over the outline) as the texture of the front,
// seen from there; beside it in the texture lies the back's, unless that is the same. Soles at y = 0, x and z
// centred, options.height_m high. Closed, 2-manifold, in one part; its
// outline lies within one cell (at least one image px) of the figure's. `silhouette` must be found and belong
// to `image`. Throws UsageError if the cell would give more than kMaxInflatedVertices.
//
// `pieces`, if there are any, cover the figure, the farthest first, and lie within it: then each is a closed
// body of its own, wears what the drawing shows of it, its hidden parts filled from around them, and lies
// before those before it where `over` says so.
TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options = {},
                     const std::vector<FigurePiece>& pieces = {});

inline constexpr int kMaxInflatedVertices = 1'000'000;
// The smallest limit of a texture.
inline constexpr int kLeastMaxTexture = 32;

}  // namespace skel
