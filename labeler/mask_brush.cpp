#include "labeler/mask_brush.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

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

bool paintArea(Plane8& mask, const Image& image, const Eigen::Vector2d& at, std::uint8_t value) {
  constexpr int kAlike =
      26;  // of 255, each of red, green, blue and alpha: more than paper and compression sway
  constexpr int kReach = 1;  // px of the seed's surroundings whose mean is its colour
  const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return false;
  std::array<int, 4> seed{};
  int seen = 0;
  for (int v = std::max(0, y - kReach); v <= std::min(image.height - 1, y + kReach); ++v)
    for (int u = std::max(0, x - kReach); u <= std::min(image.width - 1, x + kReach); ++u, ++seen)
      for (int c = 0; c < 4; ++c) seed[c] += image.pixel(u, v)[c];
  for (int& channel : seed) channel /= seen;
  Plane8 area = Plane8::Zero(mask.rows(), mask.cols());
  std::vector<std::array<int, 2>> open = {{x, y}};
  area(y, x) = 1;
  while (!open.empty()) {
    const auto [u, v] = open.back();
    open.pop_back();
    for (const auto& [du, dv] : {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) {
      const int p = u + du, q = v + dv;
      if (p < 0 || q < 0 || p >= image.width || q >= image.height || area(q, p) != 0) continue;
      const std::uint8_t* color = image.pixel(p, q);
      bool alike = true;
      for (int c = 0; c < 4; ++c) alike = alike && std::abs(color[c] - seed[c]) <= kAlike;
      if (!alike) continue;
      area(q, p) = 1;
      open.push_back({p, q});
    }
  }
  bool changed = false;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const int left = std::max(0, u - 1), top = std::max(0, v - 1);
      const bool near = (area.block(top, left, std::min(image.height - 1, v + 1) - top + 1,
                                    std::min(image.width - 1, u + 1) - left + 1) != 0)
                            .any();
      if (!near || mask(v, u) == value) continue;
      mask(v, u) = value;
      changed = true;
    }
  return changed;
}

}  // namespace skel
