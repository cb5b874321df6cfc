// What somebody may have meant who mistyped a name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skel {

// The word that the fewest insertions, deletions and exchanges of letters make of `typed`; of several the
// first. "" if even that takes more than a third of its letters. V. Levenshtein (1966).
std::string nearestWord(std::string_view typed, const std::vector<std::string>& words);

}  // namespace skel
