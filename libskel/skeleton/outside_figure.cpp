#include "libskel/skeleton/outside_figure.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

constexpr double kFar = 0.2;  // of the figure's long side

// Pixels of row y of the figure within `reach` of p?
bool rowNear(const Plane8& mask, int y, const Eigen::Vector2d& p, double reach) {
  const double rest = reach * reach - (y - p.y()) * (y - p.y());
  if (rest < 0) return false;
  const double half = std::sqrt(rest);
  const int x0 = std::max(0, static_cast<int>(std::ceil(p.x() - half)));
  const int x1 = std::min(static_cast<int>(mask.cols()) - 1, static_cast<int>(std::floor(p.x() + half)));
  for (int x = x0; x <= x1; ++x)
    if (mask(y, x)) return true;
  return false;
}

}  // namespace

const Joint* jointFarOutside(const Skeleton& skeleton, const Plane8& mask) {
  const int height = static_cast<int>(mask.rows()), width = static_cast<int>(mask.cols());
  int x0 = width, x1 = -1, y0 = height, y1 = -1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (mask(y, x)) x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  const double reach = kFar * std::max(x1 - x0 + 1, y1 - y0 + 1);
  for (const Joint& joint : skeleton.joints) {
    const int middle = std::clamp(static_cast<int>(std::lround(joint.image.y())), 0, height - 1);
    const int span = static_cast<int>(std::ceil(reach)) + 1;
    bool near = false;
    // From its own row outwards: most joints lie on the figure.
    for (int step = 0; step <= span && !near; ++step) {
      near = (middle - step >= 0 && rowNear(mask, middle - step, joint.image, reach)) ||
             (middle + step < height && rowNear(mask, middle + step, joint.image, reach));
    }
    if (!near) return &joint;
  }
  return nullptr;
}

}  // namespace skel
