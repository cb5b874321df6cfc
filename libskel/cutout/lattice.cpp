#include "libskel/cutout/lattice.h"

#include <algorithm>
#include <numeric>

#include "libskel/core/check.h"

namespace skel {
namespace {

// Copies' corners that are one vertex.
class CornerUnion {
 public:
  explicit CornerUnion(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }
  int top(int corner) {
    while (above_[std::size_t(corner)] != corner)
      corner = above_[std::size_t(corner)] = above_[std::size_t(above_[std::size_t(corner)])];
    return corner;
  }
  void join(int a, int b) {
    a = top(a), b = top(b);
    above_[std::size_t(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> above_;
};

}  // namespace

Lattice latticeOf(const Plane8& mask, int side_px) {
  SKEL_CHECK(side_px >= 1);
  Lattice lattice;
  lattice.side_px = side_px;
  const int width = int(mask.cols()), height = int(mask.rows());
  auto& square_of = lattice.square_of;
  square_of.setConstant(height, width, -1);
  const Eigen::Vector2i kSteps[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  std::vector<Eigen::Vector2i> stack;
  for (int top = 0; top < height; top += side_px)
    for (int left = 0; left < width; left += side_px) {
      const int right = std::min(left + side_px, width), bottom = std::min(top + side_px, height);
      const std::size_t first = lattice.squares.size();
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
          if (mask(y, x) == 0 || square_of(y, x) >= 0) continue;
          const int square = int(lattice.squares.size());
          square_of(y, x) = square;
          stack.emplace_back(x, y);
          while (!stack.empty()) {
            const Eigen::Vector2i p = stack.back();
            stack.pop_back();
            for (const auto& step : kSteps) {
              const Eigen::Vector2i q = p + step;
              if (q.x() < left || q.y() < top || q.x() >= right || q.y() >= bottom) continue;
              if (mask(q.y(), q.x()) == 0 || square_of(q.y(), q.x()) >= 0) continue;
              square_of(q.y(), q.x()) = square;
              stack.push_back(q);
            }
          }
          lattice.squares.emplace_back();
          lattice.corners_px.emplace_back(left, top);
        }
      lattice.alone.resize(lattice.squares.size(), lattice.squares.size() == first + 1);
    }

  CornerUnion corners(4 * lattice.squares.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int here = square_of(y, x);
      if (here < 0) continue;
      if (x % side_px == 0 && x > 0)
        if (const int before = square_of(y, x - 1); before >= 0) {
          corners.join(4 * here, 4 * before + 1);
          corners.join(4 * here + 2, 4 * before + 3);
        }
      if (y % side_px == 0 && y > 0)
        if (const int above = square_of(y - 1, x); above >= 0) {
          corners.join(4 * here, 4 * above + 2);
          corners.join(4 * here + 1, 4 * above + 3);
        }
    }
  std::vector<int> vertex(4 * lattice.squares.size(), -1);
  std::vector<Eigen::Vector2d> places;
  for (std::size_t s = 0; s < lattice.squares.size(); ++s)
    for (int k = 0; k < 4; ++k) {
      int& v = vertex[std::size_t(corners.top(4 * int(s) + k))];
      if (v < 0) {
        v = int(places.size());
        const Eigen::Vector2i corner = lattice.corners_px[s] + side_px * Eigen::Vector2i(k % 2, k / 2);
        places.push_back(corner.cast<double>().array() - 0.5);
      }
      lattice.squares[s][std::size_t(k)] = v;
    }
  lattice.vertices.resize(Eigen::Index(places.size()), 2);
  for (std::size_t v = 0; v < places.size(); ++v) lattice.vertices.row(Eigen::Index(v)) = places[v];
  return lattice;
}

Eigen::MatrixX3i Lattice::triangles() const {
  Eigen::MatrixX3i result(2 * Eigen::Index(squares.size()), 3);
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < squares.size(); ++s)
    for (const auto& [a, b, c] : halves(s)) result.row(row++) << squares[s][a], squares[s][b], squares[s][c];
  return result;
}

}  // namespace skel
