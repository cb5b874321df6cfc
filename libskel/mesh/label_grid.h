// Which nodes of a square grid belong to the figure, and where the figure's outline crosses the grid's edges.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/outline.h"

namespace skel {

// Node (i, j), column i and row j, lies at origin + cell·(i, j), image px. The outermost nodes are outside.
struct LabelGrid {
  int columns = 0, rows = 0;
  double cell_px = 0;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  std::vector<std::uint8_t> inside;  // rows × columns, 0 or 1; 4-connected if the figure is

  // Where the outline crosses the edge from node (i, j) to (i + 1, j), and to (i, j + 1): the first and the
  // last place, as a share of the edge; none: first > last.
  struct Crossing {
    float first = 2, last = -1;
  };
  std::vector<Crossing> across, down;
  std::vector<std::uint8_t> in_outline;  // as the curves alone would have it

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * columns + i; }
  Eigen::Vector2d node(int i, int j) const { return origin + cell_px * Eigen::Vector2d(i, j); }
};

// `curves` is the smoothed outline of `mask`. Thin parts that hold no node get some, so that the figure stays
// in one part; gaps that hold no node are cut open from their mouth where that cuts nothing else.
LabelGrid labelGrid(const Plane8& mask, const PixelBox& box, const std::vector<Polygon>& curves,
                    double cell_px);

}  // namespace skel
