// Drawings of one picture are measured and learned from together, whoever's they are called.
#pragma once

#include <string>
#include <vector>

#include "trainer/hands.h"

namespace skel {

// Gives drawings of one picture to one hand: that of the first whose hand is known, else the first's own.
// With folds, says so. `images`: paths.
void uniteTwins(const std::vector<std::string>& images, int folds, Hands& hands);

}  // namespace skel
