#include "libskel/cutout/lattice.h"

#include <set>

#include "tests/support/catch.h"

using namespace skel;

namespace {

// Trousers: a belt, and two legs with a gap of one pixel between them.
Plane8 trousers() {
  Plane8 mask = Plane8::Zero(40, 23);
  mask.block(0, 0, 8, 23) = 255;
  mask.block(8, 0, 32, 11) = 255;
  mask.block(8, 12, 32, 11) = 255;
  return mask;
}

std::set<int> verticesOf(const Lattice& lattice, int x0, int x1, int y0, int y1) {
  std::set<int> vertices;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (const int square = lattice.square_of(y, x); square >= 0)
        vertices.insert(lattice.squares[std::size_t(square)].begin(),
                        lattice.squares[std::size_t(square)].end());
  return vertices;
}

}  // namespace

TEST_CASE("each pixel of the figure is in the square that shows it, and no other has a square") {
  const Plane8 mask = trousers();
  for (const int side_px : {1, 3, 8, 50}) {
    CAPTURE(side_px);
    const Lattice lattice = latticeOf(mask, side_px);
    for (int y = 0; y < mask.rows(); ++y)
      for (int x = 0; x < mask.cols(); ++x) {
        const int square = lattice.square_of(y, x);
        REQUIRE((square >= 0) == (mask(y, x) != 0));
        if (square < 0) continue;
        const auto& corners = lattice.squares[std::size_t(square)];
        CHECK(lattice.vertices(corners[0], 0) < x);
        CHECK(lattice.vertices(corners[3], 0) > x);
        CHECK(lattice.vertices(corners[0], 1) < y);
        CHECK(lattice.vertices(corners[3], 1) > y);
      }
    const Eigen::MatrixX3i triangles = lattice.triangles();
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      const Eigen::Vector2d a = lattice.vertices.row(triangles(t, 0)),
                            b = lattice.vertices.row(triangles(t, 1)),
                            c = lattice.vertices.row(triangles(t, 2));
      CHECK((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x() == Approx(-side_px * side_px));
    }
  }
}

TEST_CASE("legs with a gap of one pixel between them are apart in squares of many") {
  const Lattice lattice = latticeOf(trousers(), 8);
  const std::set<int> left = verticesOf(lattice, 0, 11, 16, 40), right = verticesOf(lattice, 12, 23, 16, 40);
  for (const int vertex : left) CHECK(right.count(vertex) == 0);
  const std::size_t square = std::size_t(lattice.square_of(20, 9));
  CHECK_FALSE(lattice.alone[square]);
  CHECK(lattice.alone[std::size_t(lattice.square_of(20, 3))]);
}
