#include "libskel/mesh/label_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skel {
namespace {

// Eight neighbours, counter-clockwise; even entries are the four that share a side.
constexpr int kRing[8][2] = {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}};

// What a node's neighbours say about changing it.
struct Neighbourhood {
  int inner_sides = 0;   // of the 4
  int outer_around = 0;  // of the 8
  // Changing the node neither joins, splits, makes nor fills anything (4-connected figure, 8-connected
  // background): S. Yokoi, J. Toriwaki, T. Fukumura, "An analysis of topological properties of digitized
  // binary pictures using local features" (1975), crossing number 1.
  bool simple = false;
};

Neighbourhood look(const LabelGrid& grid, int i, int j) {
  int x[10];
  Neighbourhood result;
  for (int k = 0; k < 8; ++k) {
    x[k] = grid.inside[grid.index(i + kRing[k][0], j + kRing[k][1])];
    result.outer_around += 1 - x[k];
  }
  x[8] = x[0], x[9] = x[1];
  int crossings = 0;
  for (int k = 0; k < 8; k += 2) {
    result.inner_sides += x[k];
    crossings += x[k] - x[k] * x[k + 1] * x[k + 2];
  }
  result.simple = crossings == 1;
  return result;
}

void traceCrossings(LabelGrid& grid, const std::vector<Polygon>& curves) {
  grid.in_outline.assign(grid.inside.size(), 0);
  const auto add = [](LabelGrid::Crossing& crossing, double t) {
    crossing.first = std::min(crossing.first, static_cast<float>(t));
    crossing.last = std::max(crossing.last, static_cast<float>(t));
  };
  for (const Polygon& curve : curves) {
    Eigen::Vector2d p = (curve.back() - grid.origin) / grid.cell_px;
    for (const Eigen::Vector2d& point : curve) {
      const Eigen::Vector2d q = (point - grid.origin) / grid.cell_px;
      for (int axis = 0; axis < 2; ++axis) {
        // Lines k with (p < k) != (q < k), so that each passage counts once.
        const int low = static_cast<int>(std::floor(std::min(p[axis], q[axis]))) + 1;
        const int high = static_cast<int>(std::floor(std::max(p[axis], q[axis])));
        for (int k = low; k <= high; ++k) {
          const double t = (k - p[axis]) / (q[axis] - p[axis]);
          const double at = p[1 - axis] + t * (q[1 - axis] - p[1 - axis]);
          const int cell = static_cast<int>(std::floor(at));
          if (axis == 0) {
            add(grid.down[grid.index(k, cell)], at - cell);
          } else {
            add(grid.across[grid.index(cell, k)], at - cell);
            grid.in_outline[grid.index(cell + 1, k)] ^= 1;
          }
        }
      }
      p = q;
    }
  }
  for (int j = 0; j < grid.rows; ++j) {
    std::uint8_t in = 0;
    for (int i = 0; i < grid.columns; ++i) {
      in ^= grid.in_outline[grid.index(i, j)];
      grid.in_outline[grid.index(i, j)] = in;
    }
  }
}

// Cells of at most one px: each pixel holds a node, so that the pixels' own labels have the figure's
// topology. They then follow the smooth outline as far as no step changes that.
void labelFine(const Plane8& mask, const PixelBox& box, LabelGrid& grid) {
  std::vector<std::size_t> differing;
  for (int j = 1; j + 1 < grid.rows; ++j) {
    const int y = static_cast<int>(std::floor(grid.node(0, j).y() + 0.5));
    if (y < box.y0 || y >= box.y1) continue;
    for (int i = 1; i + 1 < grid.columns; ++i) {
      const int x = static_cast<int>(std::floor(grid.node(i, j).x() + 0.5));
      if (x >= box.x0 && x < box.x1 && mask(y, x) != 0) grid.inside[grid.index(i, j)] = 1;
    }
  }
  for (int j = 1; j + 1 < grid.rows; ++j) {
    for (int i = 1; i + 1 < grid.columns; ++i) {
      if (grid.inside[grid.index(i, j)] != grid.in_outline[grid.index(i, j)])
        differing.push_back(grid.index(i, j));
    }
  }
  for (std::size_t before = 0; before != differing.size();) {
    before = differing.size();
    std::erase_if(differing, [&](std::size_t node) {
      const int i = static_cast<int>(node % grid.columns), j = static_cast<int>(node / grid.columns);
      const Neighbourhood around = look(grid, i, j);
      const bool tip = grid.inside[node] ? around.inner_sides < 2 : around.outer_around < 2;
      if (!around.simple || tip) return false;
      grid.inside[node] ^= 1;
      return true;
    });
  }
}

// Joins the parts of grid.inside by shortest paths through `covered`, which holds them all in one 4-connected
// piece.
void joinParts(LabelGrid& grid, const std::vector<std::uint8_t>& covered) {
  const int steps[4] = {1, -1, grid.columns, -grid.columns};
  // A wave from all parts at once; where the waves of two parts meet, a path between them is found.
  std::vector<int> part(grid.inside.size(), -1), back(grid.inside.size(), -1),
      distance(grid.inside.size(), 0);
  std::vector<std::size_t> wave;
  int parts = 0;
  for (std::size_t start = 0; start < grid.inside.size(); ++start) {
    if (!grid.inside[start] || part[start] >= 0) continue;
    std::size_t next = wave.size();
    wave.push_back(start);
    part[start] = parts;
    for (; next < wave.size(); ++next) {
      for (const int step : steps) {
        const std::size_t to = wave[next] + step;
        if (grid.inside[to] && part[to] < 0) part[to] = parts, wave.push_back(to);
      }
    }
    ++parts;
  }
  if (parts < 2) return;
  struct Bridge {
    int length;
    std::size_t a, b;
  };
  std::vector<Bridge> bridges;
  for (std::size_t next = 0; next < wave.size(); ++next) {
    const std::size_t from = wave[next];
    for (const int step : steps) {
      const std::size_t to = from + step;
      if (!covered[to]) continue;
      if (part[to] < 0) {
        part[to] = part[from], back[to] = static_cast<int>(from), distance[to] = distance[from] + 1;
        wave.push_back(to);
      } else if (part[to] != part[from]) {
        bridges.push_back({distance[to] + distance[from], from, to});
      }
    }
  }
  std::stable_sort(bridges.begin(), bridges.end(),
                   [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
  std::vector<int> root(parts);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int p) {
    while (root[p] != p) p = root[p] = root[root[p]];
    return p;
  };
  for (const Bridge& bridge : bridges) {
    const int a = find(part[bridge.a]), b = find(part[bridge.b]);
    if (a == b) continue;
    root[a] = b;
    for (const std::size_t end : {bridge.a, bridge.b}) {
      for (int node = static_cast<int>(end); node >= 0 && !grid.inside[node]; node = back[node])
        grid.inside[node] = 1;
    }
  }
}

// Cells larger than a px: nodes within the outline; then what slips between the nodes is mended.
void labelCoarse(const Plane8& mask, const PixelBox& box, LabelGrid& grid) {
  grid.inside = grid.in_outline;
  std::vector<std::uint8_t> covered(grid.inside.size(),
                                    0);  // nodes that are the nearest to some figure pixel
  struct Place {
    int cell, nearest;
  };
  const auto place = [&](double p, double origin) {
    const double at = (p - origin) / grid.cell_px;
    return Place{static_cast<int>(std::floor(at)), static_cast<int>(std::floor(at + 0.5))};
  };
  std::vector<Place> columns(box.width());
  for (int x = box.x0; x < box.x1; ++x) columns[x - box.x0] = place(x, grid.origin.x());
  for (int y = box.y0; y < box.y1; ++y) {
    const Place row = place(y, grid.origin.y());
    const std::uint8_t* pixels = mask.data() + mask.cols() * y;
    for (int x = box.x0; x < box.x1; ++x) {
      if (pixels[x]) covered[grid.index(columns[x - box.x0].nearest, row.nearest)] = 1;
    }
  }
  for (std::size_t node = 0; node < covered.size(); ++node) grid.inside[node] &= covered[node];

  const auto corners = [&](int i, int j) {
    const std::size_t node = grid.index(i, j);
    return grid.inside[node] + grid.inside[node + 1] + grid.inside[node + grid.columns] +
           grid.inside[node + grid.columns + 1];
  };
  struct Gap {
    Place column, row;
  };
  std::vector<Gap> gaps;
  for (int y = box.y0; y < box.y1; ++y) {
    const Place row = place(y, grid.origin.y());
    const std::uint8_t* pixels = mask.data() + mask.cols() * y;
    for (int x = box.x0; x < box.x1; ++x) {
      const Place column = columns[x - box.x0];
      if (pixels[x] && corners(column.cell, row.cell) == 0)
        grid.inside[grid.index(column.nearest, row.nearest)] = 1;
    }
  }
  joinParts(grid, covered);
  for (int y = box.y0; y < box.y1; ++y) {
    const Place row = place(y, grid.origin.y());
    const std::uint8_t* pixels = mask.data() + mask.cols() * y;
    for (int x = box.x0; x < box.x1; ++x) {
      const Place column = columns[x - box.x0];
      if (!pixels[x] && corners(column.cell, row.cell) == 4) gaps.push_back({column, row});
    }
  }
  for (std::size_t before = 0; before != gaps.size();) {
    before = gaps.size();
    std::erase_if(gaps, [&](const Gap& gap) {
      if (corners(gap.column.cell, gap.row.cell) < 4) return true;
      const Neighbourhood around = look(grid, gap.column.nearest, gap.row.nearest);
      if (!around.simple || around.inner_sides < 2) return false;
      grid.inside[grid.index(gap.column.nearest, gap.row.nearest)] = 0;
      return true;
    });
  }
}

}  // namespace

LabelGrid labelGrid(const Plane8& mask, const PixelBox& box, const std::vector<Polygon>& curves,
                    double cell_px) {
  LabelGrid grid;
  grid.cell_px = cell_px;
  // Two nodes' room on every side, and the figure in the middle, so that a symmetric figure gets a symmetric
  // grid.
  grid.columns = static_cast<int>(std::ceil(box.width() / cell_px)) + 5;
  grid.rows = static_cast<int>(std::ceil(box.height() / cell_px)) + 5;
  grid.origin = 0.5 * (Eigen::Vector2d(box.x0 + box.x1 - 1, box.y0 + box.y1 - 1) -
                       cell_px * Eigen::Vector2d(grid.columns - 1, grid.rows - 1));
  grid.inside.assign(static_cast<std::size_t>(grid.columns) * grid.rows, 0);
  grid.across.assign(grid.inside.size(), {});
  grid.down.assign(grid.inside.size(), {});
  traceCrossings(grid, curves);
  if (cell_px <= 1) {
    labelFine(mask, box, grid);
  } else {
    labelCoarse(mask, box, grid);
  }
  return grid;
}

}  // namespace skel
