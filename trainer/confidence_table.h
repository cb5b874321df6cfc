// What confidence is learned from, as a table: to look at many drawings takes long, to learn from that does
// not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trainer/confidence_samples.h"

namespace skel {

// Lines of values between commas, the first "skel-confidence-table,1", format and version (before there were
// versions there was none, and tables one behind the other have several); then F, name of the drawing
// (commas, % and control characters as in an address: %2C), disturbance, body plan, usable, likeness,
// kFigureInputs; and after each, of every joint J, the same three, right, mass, whether it counts,
// kJointInputs.
std::string formatConfidenceTable(const std::vector<ConfidenceSample>& samples);
// Throws InputError with the number of the line.
std::vector<ConfidenceSample> parseConfidenceTable(std::string_view text, const std::string& file);

}  // namespace skel
