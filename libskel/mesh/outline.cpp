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

namespace {

int lengthOf(const Eigen::Vector2d& side) { return static_cast<int>(std::lround(side.lpNorm<1>())); }

// Each point becomes the mean of those up to `radius` beside it along the loop. In place: an outline may have
// millions of points.
void evenOut(Polygon& curve, int radius) {
  const int count = static_cast<int>(curve.size()), span = 2 * radius + 2;
  const Polygon first(curve.begin(), curve.begin() + span);
  Polygon around(span);  // what stood at i - radius to i + radius + 1, at the place of its number modulo span
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = -radius; k <= radius; ++k) {
    around[(k + span) % span] = curve[(k + count) % count];
    sum += around[(k + span) % span];
  }
  for (int i = 0; i < count; ++i) {
    const int next = i + radius + 1;
    around[next % span] = next < count ? curve[next] : first[next - count];
    curve[i] = sum / (2 * radius + 1);
    sum += around[next % span] - around[(i - radius + span) % span];
  }
}

}  // namespace

Polygon sideMiddles(const Polygon& corners) {
  const auto sideFrom = [&](std::size_t i) -> Eigen::Vector2d {
    return corners[(i + 1) % corners.size()] - corners[i];
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) count += static_cast<std::size_t>(lengthOf(sideFrom(i)));
  Polygon middles;
  middles.reserve(count);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = sideFrom(i);
    const int length = lengthOf(side);
    for (int k = 0; k < length; ++k) middles.push_back(corners[i] + side * ((k + 0.5) / length));
  }
  return middles;
}

void smoothOutline(Polygon& curve, int radius, double limit_px) {
  const int count = static_cast<int>(curve.size());
  radius = std::min(radius, count / 8);  // a small loop keeps its shape
  if (radius == 0) return;
  Polygon mean = curve;
  for (int pass = 0; pass < 2; ++pass) evenOut(mean, radius);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector2d move = mean[i] - curve[i];
    const double length = move.norm();
    if (length > limit_px) move *= limit_px / length;
    curve[i] += move;
  }
}

}  // namespace skel
