// Stage 5: from candidates to a skeleton in the drawing.
#pragma once

#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct Recognition {
  Skeleton skeleton;  // image px; positions in the model are not set yet
  // [0, 1]: the chance that the skeleton is usable as it is, every joint within 15 % of the figure's long
  // side of where a person would place it.
  double confidence = 0;
  double likeness = 0;  // [0, 1]: the chance that this is one whole figure of the template's body plan; 1 by
                        // the rules of the paper
  int turned_deg = 0;   // how far the figure is turned clockwise against upright, 0 to 359
  std::vector<std::string> missing;   // names of joints that were not found
  std::vector<std::string> warnings;  // one sentence each
};

}  // namespace skel
