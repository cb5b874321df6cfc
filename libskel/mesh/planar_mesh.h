// A figure cut into well-shaped triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/outline.h"

namespace skel {

// The first `inner_count` vertices lie inside the figure, the others on its rim. Every triangle has an inner
// vertex and no edge but those of `rim` joins two rim vertices, so that two sheets of it welded at the rim
// make a closed 2-manifold.
struct PlanarMesh {
  std::vector<Eigen::Vector2d> vertices;      // image px
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise as seen in the drawing
  std::vector<std::pair<int, int>> rim;       // directed edges, the figure to the left as seen in the drawing
  int inner_count = 0;
  double cell_px = 0;  // of the grid, image px
};

// `mask` holds one 4-connected figure, `outline` its sideMiddles(). The mesh's outline lies within
// max(cell_px, 1 px) of the figure's. Up to cells of one px, it has exactly the figure's holes; with larger
// ones it stays in one part, but holes and gaps smaller than a cell may be lost.
PlanarMesh triangulateFigure(const Plane8& mask, const PixelBox& box, std::vector<Polygon> outline,
                             double cell_px);

}  // namespace skel
