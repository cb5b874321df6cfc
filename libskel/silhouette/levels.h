// Small sums over 8-bit levels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace skel {

inline std::uint8_t toByte(float v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f)); }

// Reorders `values`, of which there must be some.
inline double median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace skel
