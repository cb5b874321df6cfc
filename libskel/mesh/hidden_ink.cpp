#include "libskel/mesh/hidden_ink.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/mesh/ink.h"
#include "libskel/mesh/outline_band.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr double kLeftDarkest = 150, kLeftContrast = 40;  // inkLightness(): a line is darker, by so much
constexpr double kDrawnShare = .5;                        // of the rim that is seen

double inkLightnessOf(const std::uint8_t* c) { return inkLightness(c[0], c[1], c[2]); }

// The darkest px of the line that begins there.
std::array<std::uint8_t, 3> inkAt(const Image& image, const Plane8& mask, const OutlineSample& sample) {
  const int reach = std::max(1, static_cast<int>(std::ceil(sample.width_px / 2)));
  const int x = static_cast<int>(std::lround(sample.point.x())),
            y = static_cast<int>(std::lround(sample.point.y()));
  std::array<std::uint8_t, 3> ink{};
  double darkest = 256;
  for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u) {
      const std::uint8_t* c = image.pixel(u, v);
      if (mask(v, u) == 0 || inkLightnessOf(c) >= darkest) continue;
      darkest = inkLightnessOf(c);
      ink = {c[0], c[1], c[2]};
    }
  return ink;
}

}  // namespace

Plane8 withLeftInk(const Image& image, const Plane8& known, const Plane8& hidden, int reach_px) {
  Plane8 grown = hidden;
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const auto within = [&](int x, int y) { return x >= 0 && y >= 0 && x < image.width && y < image.height; };
  // Darker than something of the piece nearby.
  const auto isLine = [&](int x, int y) {
    const double own = inkLightnessOf(image.pixel(x, y));
    if (own > kLeftDarkest) return false;
    for (int v = std::max(0, y - reach_px); v <= std::min(image.height - 1, y + reach_px); ++v)
      for (int u = std::max(0, x - reach_px); u <= std::min(image.width - 1, x + reach_px); ++u)
        if (known(v, u) != 0 && hidden(v, u) == 0 && inkLightnessOf(image.pixel(u, v)) > own + kLeftContrast)
          return true;
    return false;
  };
  std::vector<Eigen::Vector2i> front, next;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (hidden(y, x) != 0) front.emplace_back(x, y);
  for (int step = 0; step < reach_px && !front.empty(); ++step) {
    next.clear();
    for (const Eigen::Vector2i& p : front)
      for (const auto& by : kSteps) {
        const int u = p.x() + by[0], v = p.y() + by[1];
        if (!within(u, v) || known(v, u) == 0 || grown(v, u) != 0 || !isLine(u, v)) continue;
        grown(v, u) = 1;
        next.emplace_back(u, v);
      }
    front.swap(next);
  }
  return grown;
}

void inkHiddenRim(const Plane8& mask, const Plane8& hidden, const std::vector<std::vector<Vector2d>>& outline,
                  Image& image) {
  if ((hidden == 0).all()) return;
  const auto isHidden = [&](const Vector2d& p) {
    const auto x = static_cast<Eigen::Index>(std::lround(p.x())),
               y = static_cast<Eigen::Index>(std::lround(p.y()));
    for (Eigen::Index v = std::max<Eigen::Index>(0, y - 1); v <= std::min(hidden.rows() - 1, y + 1); ++v)
      for (Eigen::Index u = std::max<Eigen::Index>(0, x - 1); u <= std::min(hidden.cols() - 1, x + 1); ++u)
        if (hidden(v, u) != 0) return true;
    return false;
  };
  struct Brush {
    Vector2d at;
    std::array<std::uint8_t, 3> ink;
  };
  std::vector<Brush> brushes;
  std::vector<double> widths;
  std::size_t seen = 0;
  for (const std::vector<Vector2d>& curve : outline) {
    const std::vector<OutlineSample> samples = drawnOutline(image, mask, {curve});
    const std::size_t size = samples.size();
    std::vector<char> covered(size);
    std::vector<std::size_t> drawn;
    for (std::size_t k = 0; k < size; ++k) {
      covered[k] = isHidden(samples[k].point);
      if (covered[k]) continue;
      ++seen;
      if (samples[k].width_px > 0) drawn.push_back(k), widths.push_back(samples[k].width_px);
    }
    if (drawn.empty()) continue;
    const auto apart = [&](std::size_t a, std::size_t b) {
      const std::size_t way = a > b ? a - b : b - a;
      return std::min(way, size - way);
    };
    for (std::size_t k = 0; k < size; ++k) {
      if (!covered[k]) continue;
      // The nearest lie around k in the ascending list, across its ends as well.
      const auto after = std::lower_bound(drawn.begin(), drawn.end(), k);
      const std::size_t later = after == drawn.end() ? drawn.front() : *after;
      const std::size_t earlier = after == drawn.begin() ? drawn.back() : *(after - 1);
      const OutlineSample& nearest = samples[apart(k, later) < apart(k, earlier) ? later : earlier];
      const Vector2d from = samples[k].point, to = samples[(k + 1) % size].point;
      const auto ink = inkAt(image, mask, nearest);
      const int steps = covered[(k + 1) % size] ? std::max(1, static_cast<int>((to - from).norm())) : 1;
      for (int i = 0; i < steps; ++i) brushes.push_back({from + double(i) / steps * (to - from), ink});
    }
  }
  if (static_cast<double>(widths.size()) < kDrawnShare * static_cast<double>(seen) || widths.empty()) return;
  std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2),
                   widths.end());
  const double width = widths[widths.size() / 2];
  const int reach = static_cast<int>(std::ceil(width));
  for (const Brush& brush : brushes) {
    const int x = static_cast<int>(std::lround(brush.at.x())),
              y = static_cast<int>(std::lround(brush.at.y()));
    for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u)
        if (hidden(v, u) != 0 && mask(v, u) != 0 && (Vector2d(u, v) - brush.at).norm() <= width)
          std::copy(brush.ink.begin(), brush.ink.end(), image.pixel(u, v));
  }
}

}  // namespace skel
