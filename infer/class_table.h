// What is said at the end of a run over many drawings.
#pragma once

#include <string>
#include <vector>

#include "infer/figure_result.h"

namespace skel {

// A line of counts, then each sentence once with the drawings that it holds for: those to retake first, those
// to look at, what else there is to know. Paths are words for the shell. `numbered`: names say which figure.
std::string classTable(const std::vector<DrawingResult>& drawings, bool numbered);

}  // namespace skel
