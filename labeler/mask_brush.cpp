#include "labeler/mask_brush.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/segment.h"

namespace skel {

bool paintLine(Plane8& mask, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_px,
               std::uint8_t value) {
  const double radius = std::max(radius_px, 0.5);
  const auto low = [&](int axis) {
    return static_cast<long>(std::ceil(std::max(std::min(from[axis], to[axis]) - radius, 0.0)));
  };
  const auto high = [&](int axis, long size) {
    return static_cast<long>(std::floor(std::min(std::max(from[axis], to[axis]) + radius, size - 1.0)));
  };
  bool changed = false;
  for (long y = low(1); y <= high(1, mask.rows()); ++y)
    for (long x = low(0); x <= high(0, mask.cols()); ++x) {
      const Eigen::Vector2d p(static_cast<double>(x), static_cast<double>(y));
      if ((nearestOnSegment(p, from, to) - p).squaredNorm() > radius * radius || mask(y, x) == value)
        continue;
      mask(y, x) = value;
      changed = true;
    }
  return changed;
}

}  // namespace skel
