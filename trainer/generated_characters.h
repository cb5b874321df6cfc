// Figures that the program draws itself, with the class of each candidate from their joints: more poses and
// builds than anyone will draw by hand.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/labels/label_folder.h"

namespace skel {

// The same for the same seed, with any number of threads (0: one a core). The first ones do not depend on how
// many follow. `before_each` (or none) is called before each of them, by any thread, and may throw.
std::vector<LabelledCharacter> generateCharacters(int count, std::uint64_t seed, int threads = 0,
                                                  const CandidateOptions& options = {},
                                                  const std::function<void()>& before_each = {});

}  // namespace skel
