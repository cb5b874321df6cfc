#include "libskel/silhouette/outline.h"

#include <algorithm>
#include <limits>

#include "libskel/core/segment.h"

namespace skel {

std::vector<Polygon> traceOutline(const Plane8& mask) {
  const Eigen::Index w = mask.cols(), h = mask.rows();
  const auto inside = [&](Eigen::Index x, Eigen::Index y) {
    return x >= 0 && y >= 0 && x < w && y < h && mask(y, x) != 0;
  };
  // Every contour, walked with the figure on the right, has a step to the right along the top of a pixel.
  Plane8 walked = Plane8::Zero(h, w);
  std::vector<Polygon> outline;
  constexpr int kDx[] = {1, 0, -1, 0}, kDy[] = {0, 1, 0, -1};  // right, down, left, up
  for (Eigen::Index start_y = 0; start_y < h; ++start_y) {
    for (Eigen::Index start_x = 0; start_x < w; ++start_x) {
      if (!inside(start_x, start_y) || inside(start_x, start_y - 1) || walked(start_y, start_x)) continue;
      Polygon polygon;
      Eigen::Index x = start_x, y = start_y;  // the corner at the top left of pixel (x, y)
      int direction = 0;
      do {
        if (direction == 0) walked(y, x) = 1;
        x += kDx[direction];
        y += kDy[direction];
        // The two pixels ahead, at the right and at the left of the way.
        const auto ahead = [&](bool right) {
          const int side = right ? 1 : -1;
          const int sx = kDx[direction] - side * kDy[direction], sy = kDy[direction] + side * kDx[direction];
          return inside(x + (sx - 1) / 2, y + (sy - 1) / 2);
        };
        int turned = direction;
        // Of two pixels that touch at a corner each keeps its own contour: the figure is 4-connected.
        if (!ahead(true)) {
          turned = (direction + 1) % 4;
        } else if (ahead(false)) {
          turned = (direction + 3) % 4;
        }
        if (turned != direction) {
          polygon.emplace_back(static_cast<double>(x) - 0.5, static_cast<double>(y) - 0.5);
          direction = turned;
        }
      } while (x != start_x || y != start_y || direction != 0);
      outline.push_back(std::move(polygon));
    }
  }
  return outline;
}

double distanceToOutline(const std::vector<Polygon>& outline, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : outline)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      least = std::min(least,
                       distanceToSegment<Eigen::Vector2d>(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  return least;
}

}  // namespace skel
