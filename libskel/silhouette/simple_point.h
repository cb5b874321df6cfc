// Pixels that can be taken from a mask without changing its topology.
#pragma once

#include <array>

namespace skel {

// Whether taking the middle out of its eight neighbours (clockwise from the top left, true on the figure)
// leaves the 4-connected figure and the 8-connected background in as many parts as before.
inline bool isSimplePoint(const std::array<bool, 8>& n) {
  int parts = 0, outside = 0;
  for (int i = 1; i < 8; i += 2) {
    outside += !n[i] + !n[i - 1];
    // A side neighbour ends a part unless it is joined to the next side neighbour around the corner.
    parts += n[i] && !(n[(i + 1) % 8] && n[(i + 2) % 8]);
  }
  return parts == 1 && outside > 0;
}

}  // namespace skel
