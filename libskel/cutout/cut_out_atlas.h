// A cut-out for those who draw triangles: one picture, one list of triangles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libskel/cutout/cut_out.h"

namespace skel {

struct CutOutAtlas {
  Image picture;                         // colours multiplied by their alpha; a tile for each square
  Eigen::MatrixX2f texcoords;            // #V×2 of [0, 1], from the picture's top left corner
  std::vector<std::uint32_t> vertex;     // #V: whose place it has, counted through the vertices of all sheets
  std::vector<std::uint32_t> triangles;  // three of the V each, in the order in which they are painted
};

// `most_px`: the longest side that the picture may have; what is larger is made smaller.
CutOutAtlas atlasOf(const CutOut& cut_out, int most_px = 4096);

}  // namespace skel
