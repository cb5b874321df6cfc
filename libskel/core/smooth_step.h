#pragma once

#include <algorithm>

namespace skel {

// From 0 at t = 0 to 1 at t = 1, level at both, and beyond them.
template <class Number>
Number smoothStep(Number t) {
  t = std::clamp(t, Number(0), Number(1));
  return t * t * (3 - 2 * t);
}

}  // namespace skel
