#include "libskel/jointnet/figure_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libskel/core/check.h"

namespace skel {
namespace {

// Range of brightness inside the figure, from the 2nd to the 98th percentile; no less than kLeastRange, since
// a figure of one colour has no lines, only noise. 0 without any pixel.
double brightnessRange(const GridColours& colours, const Plane8& mask) {
  constexpr double kLeastRange = 40;
  std::array<int, 256> histogram{};
  int pixels = 0;
  for (int i = 0; i < mask.size(); ++i) {
    if (mask.data()[i] == 0) continue;
    ++histogram[std::clamp(static_cast<int>(colours.row(i).mean()), 0, 255)];
    ++pixels;
  }
  if (pixels == 0) return 0;
  const auto percentile = [&](double share) {
    int left = static_cast<int>(share * pixels), value = 0;
    while (value < 255 && left >= histogram[value]) left -= histogram[value++];
    return value;
  };
  return std::max<double>(kLeastRange, percentile(.98) - percentile(.02));
}

}  // namespace

Plane8 lineStrength(const GridColours& colours, const Plane8& mask) {
  const int width = static_cast<int>(mask.cols()), height = static_cast<int>(mask.rows());
  SKEL_CHECK_EQ(colours.rows(), mask.size());
  Plane8 strength = Plane8::Zero(height, width);
  const double range = brightnessRange(colours, mask);
  if (range == 0) return strength;
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

FigureLook figureLook(const GridColours& colours, const Plane8& mask) {
  FigureLook look;
  look.lines = lineStrength(colours, mask);
  for (Plane8& tone : look.tones) tone = Plane8::Constant(mask.rows(), mask.cols(), kMeanTone);
  const double range = brightnessRange(colours, mask);
  if (range == 0) return look;
  // Chroma spans more than brightness only in garish figures; a grey one has none that could be stretched.
  const Eigen::Array3f scale(static_cast<float>(160 / range), .5f, .5f);
  const auto toneOf = [&](int i) {
    const auto c = colours.row(i);
    return Eigen::Array3f(c.mean(), c(0) - c(1), c(2) - (c(0) + c(1)) / 2);
  };
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  int pixels = 0;
  for (int i = 0; i < mask.size(); ++i) {
    if (mask.data()[i] == 0) continue;
    sum += toneOf(i).cast<double>();
    ++pixels;
  }
  const Eigen::Array3f mean = (sum / pixels).cast<float>();
  for (int i = 0; i < mask.size(); ++i) {
    if (mask.data()[i] == 0) continue;
    const Eigen::Array3f t = (static_cast<float>(kMeanTone) + (toneOf(i) - mean) * scale).max(0).min(255);
    for (int k = 0; k < 3; ++k) look.tones[k].data()[i] = static_cast<std::uint8_t>(std::lround(t[k]));
  }
  return look;
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
  std::vector<std::pair<int, int>> columns;
  for (int x = 0; x < width; ++x) columns.push_back(range(x, corner_px.x(), image.width));
  for (int y = 0; y < height; ++y) {
    const auto [y0, y1] = range(y, corner_px.y(), image.height);
    for (int x = 0; x < width; ++x) {
      const auto [x0, x1] = columns[static_cast<std::size_t>(x)];
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
