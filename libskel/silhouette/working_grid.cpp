#include "libskel/silhouette/working_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/silhouette/simple_point.h"

namespace skel {
namespace {

using PlaneF = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Box {
  Eigen::Index left, top, right, bottom;  // right and bottom are outside
};

Box boxOf(const Plane8& mask) {
  Box box{mask.cols(), mask.rows(), 0, 0};
  for (Eigen::Index y = 0; y < mask.rows(); ++y) {
    for (Eigen::Index x = 0; x < mask.cols(); ++x) {
      if (mask(y, x) == 0) continue;
      box.left = std::min(box.left, x);
      box.right = std::max(box.right, x + 1);
      box.top = std::min(box.top, y);
      box.bottom = y + 1;
    }
  }
  return box;
}

// How much of [begin, end) each unit cell of a row takes: calls add(cell, length).
template <class Add>
void overCells(double begin, double end, Eigen::Index cells, Add add) {
  for (auto cell = static_cast<Eigen::Index>(begin); cell < cells && static_cast<double>(cell) < end;
       ++cell) {
    const double length = std::min(end, cell + 1.0) - std::max(begin, static_cast<double>(cell));
    if (length > 0) add(cell, static_cast<float>(length));
  }
}

// Share of each grid pixel that the mask covers.
PlaneF coverage(const Plane8& mask, const WorkingGrid& grid) {
  const Box box = boxOf(mask);
  PlaneF covered = PlaneF::Zero(grid.height, grid.width);
  Eigen::ArrayXf row(grid.width);
  for (Eigen::Index y = box.top; y < box.bottom; ++y) {
    row.setZero();
    // Runs, not pixels: large masks have few of them.
    for (Eigen::Index x = box.left; x < box.right;) {
      if (mask(y, x) == 0) {
        ++x;
        continue;
      }
      const Eigen::Index begin = x;
      while (x < box.right && mask(y, x) != 0) ++x;
      overCells((static_cast<double>(begin) - grid.corner_px.x()) * grid.scale,
                (static_cast<double>(x) - grid.corner_px.x()) * grid.scale, grid.width,
                [&](Eigen::Index cell, float length) { row(cell) += length; });
    }
    const double top = (static_cast<double>(y) - grid.corner_px.y()) * grid.scale;
    overCells(top, top + grid.scale, grid.height,
              [&](Eigen::Index cell, float length) { covered.row(cell) += length * row.transpose(); });
  }
  return covered;
}

}  // namespace

WorkingGrid gridOver(const Plane8& mask) {
  const Box box = boxOf(mask);
  SKEL_CHECK(box.right > box.left);
  const double width = static_cast<double>(box.right - box.left);
  const double height = static_cast<double>(box.bottom - box.top);
  WorkingGrid grid;
  grid.scale = kWorkingGridSize / std::max(width, height);
  grid.width = std::max(1, static_cast<int>(std::ceil(width * grid.scale - 1e-9)));
  grid.height = std::max(1, static_cast<int>(std::ceil(height * grid.scale - 1e-9)));
  grid.corner_px = {static_cast<double>(box.left), static_cast<double>(box.top)};
  return grid;
}

Plane8 sampleMask(const Plane8& mask, const WorkingGrid& grid) {
  const PlaneF covered = coverage(mask, grid);
  const int w = grid.width, h = grid.height;
  // Summing lengths leaves a rounding error of about 1e-5.
  constexpr float kHalf = 0.5f - 1e-4f, kNothing = 1e-4f;

  // Begin with all that is touched, which is in one piece, and take away pixels less than half covered, least
  // covered first, as long as none of them holds the figure together or ends a limb.
  Plane8 out = (covered > kNothing).select(Plane8::Constant(h, w, 255), Plane8::Zero(h, w));
  const auto at = [&](int x, int y) { return x >= 0 && y >= 0 && x < w && y < h && out(y, x) != 0; };
  const auto nearCore = [&](int x, int y) {
    const int x0 = std::max(0, x - 1), x1 = std::min(w - 1, x + 1);
    const int y0 = std::max(0, y - 1), y1 = std::min(h - 1, y + 1);
    return (covered.block(y0, x0, y1 - y0 + 1, x1 - x0 + 1) >= kHalf).any();
  };
  struct Pixel {
    float covered;
    int x, y;
    bool thin;  // part of something thinner than a grid pixel
  };
  std::vector<Pixel> doubtful;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      if (out(y, x) != 0 && covered(y, x) < kHalf) doubtful.push_back({covered(y, x), x, y, !nearCore(x, y)});
    }
  }
  std::stable_sort(doubtful.begin(), doubtful.end(),
                   [](const Pixel& a, const Pixel& b) { return a.covered < b.covered; });
  for (bool changed = true; changed;) {
    changed = false;
    for (const Pixel& p : doubtful) {
      if (out(p.y, p.x) == 0) continue;
      const int x = p.x, y = p.y;
      const std::array<bool, 8> n = {at(x - 1, y - 1), at(x, y - 1), at(x + 1, y - 1), at(x + 1, y),
                                     at(x + 1, y + 1), at(x, y + 1), at(x - 1, y + 1), at(x - 1, y)};
      const bool tip = p.thin && n[1] + n[3] + n[5] + n[7] <= 1;
      if (tip || !isSimplePoint(n)) continue;
      out(y, x) = 0;
      changed = true;
    }
  }
  return out;
}

}  // namespace skel
