#pragma once

#include <algorithm>

namespace skel {

// From 0 at t = 0 to 1 at t = 1, level at both, and beyond them.
template <class Number>
Number smoothStep(Number t) {
  t = std::clamp(t, Number(0), Number(1));
  return t * t * (3 - 2 * t);
}
// The same from 0 at x = from to 1 at x = to.
inline double smoothStep(double from, double to, double x) { return smoothStep((x - from) / (to - from)); }

}  // namespace skel
