#include "libskel/jointnet/line_strength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libskel/core/check.h"

namespace skel {

Plane8 lineStrength(const GridColours& colours, const Plane8& mask) {
  const int width = static_cast<int>(mask.cols()), height = static_cast<int>(mask.rows());
  SKEL_CHECK_EQ(colours.rows(), mask.size());
  Plane8 strength = Plane8::Zero(height, width);

  // Range of brightness from the 2nd to the 98th percentile.
  std::array<int, 256> histogram{};
  int pixels = 0;
  for (int i = 0; i < width * height; ++i) {
    if (mask.data()[i] == 0) continue;
    ++histogram[std::clamp(static_cast<int>(colours.row(i).mean()), 0, 255)];
    ++pixels;
  }
  if (pixels == 0) return strength;
  const auto percentile = [&](double share) {
    int left = static_cast<int>(share * pixels), value = 0;
    while (value < 255 && left >= histogram[value]) left -= histogram[value++];
    return value;
  };
  // A figure of one colour has no lines, only noise.
  constexpr double kLeastRange = 40;
  const double range = std::max<double>(kLeastRange, percentile(.98) - percentile(.02));
  const auto scale = static_cast<float>(255 / (.6 * range));

  const auto compare = [&](int a, int b) {
    if (mask.data()[a] == 0 || mask.data()[b] == 0) return;
    const float difference = (colours.row(a) - colours.row(b)).abs().maxCoeff();
    const auto s = static_cast<std::uint8_t>(std::min(255.f, difference * scale));
    strength.data()[a] = std::max(strength.data()[a], s);
    strength.data()[b] = std::max(strength.data()[b], s);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (x + 1 < width) compare(y * width + x, y * width + x + 1);
      if (y + 1 < height) compare(y * width + x, (y + 1) * width + x);
    }
  }
  return strength;
}

GridColours gridColours(const Image& image, const Eigen::Vector2d& corner_px, double scale, int width,
                        int height) {
  SKEL_CHECK(!image.empty() && scale > 0);
  GridColours colours(std::int64_t{width} * height, 3);
  const auto range = [&](int cell, double corner, int size) {
    const int first = std::clamp(static_cast<int>(std::floor(cell / scale + corner + .5)), 0, size - 1);
    const int last =
        std::clamp(static_cast<int>(std::floor((cell + 1) / scale + corner - .5)), first, size - 1);
    return std::pair(first, last);
  };
  for (int y = 0; y < height; ++y) {
    const auto [y0, y1] = range(y, corner_px.y(), image.height);
    for (int x = 0; x < width; ++x) {
      const auto [x0, x1] = range(x, corner_px.x(), image.width);
      std::int64_t sum[3] = {0, 0, 0};
      for (int yy = y0; yy <= y1; ++yy) {
        for (int xx = x0; xx <= x1; ++xx) {
          const std::uint8_t* p = image.pixel(xx, yy);
          for (int c = 0; c < 3; ++c) sum[c] += p[c] * p[3] + 255 * (255 - p[3]);
        }
      }
      const double count = 255. * (y1 - y0 + 1) * (x1 - x0 + 1);
      for (int c = 0; c < 3; ++c)
        colours(std::int64_t{y} * width + x, c) = static_cast<float>(sum[c] / count);
    }
  }
  return colours;
}

}  // namespace skel
