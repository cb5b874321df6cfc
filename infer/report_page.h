// One file of HTML that shows what became of many drawings.
#pragma once

#include <string>
#include <vector>

#include "infer/figure_result.h"

namespace skel {

// Needs nothing from elsewhere and runs no script. Figures without pictures are shown by name alone.
std::string reportPage(const std::vector<DrawingResult>& drawings);

}  // namespace skel
