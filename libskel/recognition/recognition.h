// Stage 5: from candidates to a skeleton in the drawing.
#pragma once

#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct Recognition {
  Skeleton skeleton;  // image px; positions in the model are not set yet
  double confidence =
      0;  // [0, 1]: that this is one whole figure of the template's body plan, and found as it is
  int turned_deg = 0;                 // how far the figure is turned clockwise against upright, 0 to 359
  std::vector<std::string> missing;   // names of joints that were not found
  std::vector<std::string> warnings;  // one sentence each
};

}  // namespace skel
