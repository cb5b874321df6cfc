// Keys of a clip as a time line shows them.
#pragma once

#include <vector>

namespace skel {

// One key, or a stretch with keys so near to each other that none can be told from the next.
struct KeyMark {
  double from_s = 0, to_s = 0;
  bool isOne() const { return from_s == to_s; }
  bool operator==(const KeyMark&) const = default;
};

// `times_s` in their order; keys nearer than `apart_s` to the one before share its mark.
std::vector<KeyMark> keyMarks(const std::vector<double>& times_s, double apart_s);

}  // namespace skel
