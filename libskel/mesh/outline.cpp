#include "libskel/mesh/outline.h"

#include <algorithm>
#include <cmath>

namespace skel {

PixelBox figureBox(const Plane8& mask) {
  PixelBox box{static_cast<int>(mask.cols()), static_cast<int>(mask.rows()), 0, 0};
  for (int y = 0; y < mask.rows(); ++y) {
    const std::uint8_t* row = mask.data() + mask.cols() * y;
    const std::uint8_t* end = row + mask.cols();
    const std::uint8_t* first = std::find_if(row, end, [](std::uint8_t value) { return value != 0; });
    if (first == end) continue;
    const std::uint8_t* last = end - 1;
    while (*last == 0) --last;
    box.x0 = std::min(box.x0, static_cast<int>(first - row));
    box.x1 = std::max(box.x1, static_cast<int>(last - row) + 1);
    box.y0 = std::min(box.y0, y);
    box.y1 = y + 1;
  }
  return box.y1 == 0 ? PixelBox{} : box;
}

Polygon sideMiddles(const Polygon& corners) {
  Polygon middles;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - a;
    const int length = static_cast<int>(std::lround(side.lpNorm<1>()));
    for (int k = 0; k < length; ++k) middles.push_back(a + side * ((k + 0.5) / length));
  }
  return middles;
}

void smoothOutline(Polygon& curve, int radius, double limit_px) {
  const int count = static_cast<int>(curve.size());
  radius = std::min(radius, count / 8);  // a small loop keeps its shape
  if (radius == 0) return;
  Polygon mean = curve, source(count);
  for (int pass = 0; pass < 2; ++pass) {
    source.swap(mean);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = -radius; k <= radius; ++k) sum += source[(k + count) % count];
    for (int i = 0; i < count; ++i) {
      mean[i] = sum / (2 * radius + 1);
      sum += source[(i + radius + 1) % count] - source[(i - radius + count) % count];
    }
  }
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2d move = mean[i] - curve[i];
    const double length = move.norm();
    if (length > limit_px) move *= limit_px / length;
    curve[i] += move;
  }
}

}  // namespace skel
