#include "libskel/recognition/nearest_pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

Plane8 halved(const Plane8& cells) {
  Plane8 half((cells.rows() + 1) / 2, (cells.cols() + 1) / 2);
  for (Index y = 0; y < half.rows(); ++y) {
    const auto above = cells.row(2 * y), below = cells.row(std::min(2 * y + 1, cells.rows() - 1));
    for (Index x = 0; x < cells.cols() / 2; ++x)
      half(y, x) = above(2 * x) | above(2 * x + 1) | below(2 * x) | below(2 * x + 1);
    if (cells.cols() % 2 == 1) half(y, half.cols() - 1) = above(cells.cols() - 1) | below(cells.cols() - 1);
  }
  return half;
}

}  // namespace

struct NearestPixel::Search {
  Vector2d point, nearest;
  double least = std::numeric_limits<double>::infinity();  // squared
};

NearestPixel::NearestPixel(const Plane8& mask) : mask_(mask) {
  while (cells(above_.size()).size() > 1) above_.push_back(halved(cells(above_.size())));
}

Vector2d NearestPixel::to(const Vector2d& point) const {
  if (onFigure(mask_, point)) return point;
  Search search{point, point};
  look(above_.size(), 0, 0, search);
  return search.nearest;
}

void NearestPixel::look(std::size_t level, Index x, Index y, Search& search) const {
  const Plane8& at = cells(level);
  if (x >= at.cols() || y >= at.rows() || at(y, x) == 0) return;
  const double side = std::ldexp(1, int(level));
  const Vector2d first = side * Vector2d(double(x), double(y)), last = first.array() + (side - 1);
  const double distance = (search.point - search.point.cwiseMax(first).cwiseMin(last)).squaredNorm();
  if (distance >= search.least) return;
  if (level == 0) {
    search.least = distance;
    search.nearest = first;
    return;
  }
  // The nearest quarter first.
  const Vector2d middle = (first + last) / 2;
  const Index right = search.point.x() > middle.x(), below = search.point.y() > middle.y();
  for (const Index dy : {below, 1 - below})
    for (const Index dx : {right, 1 - right}) look(level - 1, 2 * x + dx, 2 * y + dy, search);
}

bool onFigure(const Plane8& mask, const Vector2d& point) {
  const long x = std::lround(point.x()), y = std::lround(point.y());
  return x >= 0 && y >= 0 && x < mask.cols() && y < mask.rows() && mask(y, x) != 0;
}

}  // namespace skel
