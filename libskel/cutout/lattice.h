// A figure in the squares of a grid, each part of it that a square holds in a copy of the square.
//
// N. Molino, Z. Bao, R. Fedkiw, "A virtual node algorithm for changing mesh topology during simulation"
// (2004): what is apart in the figure is apart in the mesh, however narrow the gap, and all triangles are
// well shaped.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct Lattice {
  int side_px = 1;            // of a square
  Eigen::MatrixX2d vertices;  // #V×2, px of the mask; its pixels lie within the squares
  // Of each copy of a square: its corners, top left, top right, bottom left, bottom right.
  std::vector<std::array<int, 4>> squares;
  std::vector<Eigen::Vector2i> corners_px;  // of each: its top left pixel
  std::vector<bool> alone;                  // of each: no other copy has pixels in this square
  // Of the mask's size: which copy shows the pixel, -1 where the mask is 0.
  Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> square_of;

  // Which way a square is cut into triangles: from its top right corner, or from its top left one.
  bool cutFromTopRight(std::size_t square) const { return (corners_px[square] / side_px).sum() % 2 == 0; }
  // The two triangles, of its corners.
  std::array<std::array<std::size_t, 3>, 2> halves(std::size_t square) const {
    using Halves = std::array<std::array<std::size_t, 3>, 2>;
    return cutFromTopRight(square) ? Halves{{{0, 2, 1}, {1, 2, 3}}} : Halves{{{0, 2, 3}, {0, 3, 1}}};
  }
  // #F×3, two a square, all of one orientation.
  Eigen::MatrixX3i triangles() const;
};

// `mask`: not 0 on the figure. Copies share corners where pixels of theirs touch across a side, so that
// the lattice of a 4-connected figure is in one part. `side_px` at least 1.
Lattice latticeOf(const Plane8& mask, int side_px);

}  // namespace skel
