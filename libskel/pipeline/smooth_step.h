#pragma once

#include <algorithm>

namespace skel {

// From 0 at t = 0 to 1 at t = 1, level at both, and beyond them.
inline float smoothStep(float t) {
  t = std::clamp(t, 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

}  // namespace skel
