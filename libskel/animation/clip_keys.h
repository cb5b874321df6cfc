// What the readers of clip files share.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/animation/clip_limits.h"
#include "libskel/core/json.h"

namespace skel {

inline constexpr double kMaxAngle_deg = 3600;

// Refuses a time that does not come after the ones before; `times` grows by it.
inline void takeTime(const JsonValue& value, double time_s, std::vector<float>& times) {
  if (!(time_s >= 0 && time_s <= kMaxClip_s)) value.fail("must be a time of 0 to 3600 seconds");
  if (!times.empty() && !(float(time_s) > times.back())) value.fail("must be later than the key before");
  times.push_back(float(time_s));
}

// Three numbers of at most `limit`, each way.
inline Eigen::Vector3f vectorAt(const JsonValue& value, const double* numbers, double limit) {
  for (int k = 0; k < 3; ++k)
    if (!(numbers[k] >= -limit && numbers[k] <= limit)) value.fail("holds a number that is too large");
  return {float(numbers[0]), float(numbers[1]), float(numbers[2])};
}

}  // namespace skel
