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
  std::vector<std::string> missing;   // names of joints that were not found
  std::vector<std::string> warnings;  // one sentence each
};

}  // namespace skel
