// The 4-connected parts of a mask, as runs along its rows (A. Rosenfeld, J. Pfaltz, "Sequential operations in
// digital picture processing", 1966).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct MaskParts {
  struct Run {
    int y, x0, x1;  // columns [x0, x1)
    int part;
  };
  std::vector<Run> runs;           // by row, then column
  std::vector<std::int64_t> size;  // of each part, px; parts are numbered by their first run

  int largest() const;  // the first of the largest; -1: none
};

MaskParts maskParts(const Plane8& mask);

// Of each of the parts, how many pixels of `figure` beside it, which are of none of them, have each value of
// `plane`; one that lies beside several of its pixels counts as often.
std::vector<std::array<int, 256>> valuesBeside(const MaskParts& parts, const Plane8& figure,
                                               const Plane8& plane);

}  // namespace skel
