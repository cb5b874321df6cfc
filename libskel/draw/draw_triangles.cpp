#include "libskel/draw/draw_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr int kSamples = 2;  // each way, a pixel

std::array<std::uint8_t, 4> bilinear(const Image& texture, double x, double y) {
  x = std::clamp(x, 0., double(texture.width - 1));
  y = std::clamp(y, 0., double(texture.height - 1));
  const int x0 = int(x), y0 = int(y);
  const int x1 = std::min(x0 + 1, texture.width - 1), y1 = std::min(y0 + 1, texture.height - 1);
  const double tx = x - x0, ty = y - y0;
  const std::uint8_t *a = texture.pixel(x0, y0), *b = texture.pixel(x1, y0), *c = texture.pixel(x0, y1),
                     *d = texture.pixel(x1, y1);
  std::array<std::uint8_t, 4> color{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = std::uint8_t(
        std::lround((1 - ty) * ((1 - tx) * a[k] + tx * b[k]) + ty * ((1 - tx) * c[k] + tx * d[k])));
  return color;
}

}  // namespace

void drawTriangles(Image& image, const Eigen::MatrixX2d& places, const Eigen::MatrixX3i& triangles,
                   const Image& texture, const Eigen::MatrixX2d& texture_places) {
  SKEL_CHECK_EQ(places.rows(), texture_places.rows());
  if (image.empty() || texture.empty()) return;
  const int width = kSamples * image.width, height = kSamples * image.height;
  std::vector<std::array<std::uint8_t, 4>> samples(std::size_t(width) * std::size_t(height), {0, 0, 0, 0});
  // Sample i lies at (i + ½) / kSamples − ½ px.
  const auto toSamples = [](double px) { return (px + 0.5) * kSamples - 0.5; };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<Eigen::Vector2d, 3> p, q;
    for (int k = 0; k < 3; ++k) {
      const int v = triangles(t, k);
      p[std::size_t(k)] = {toSamples(places(v, 0)), toSamples(places(v, 1))};
      q[std::size_t(k)] = texture_places.row(v);
    }
    const Eigen::Vector2d e1 = p[1] - p[0], e2 = p[2] - p[0];
    const double area = e1.x() * e2.y() - e1.y() * e2.x();
    if (!(std::abs(area) > 1e-12)) continue;
    const Eigen::Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const int y0 = std::max(0, int(std::ceil(low.y()))), y1 = std::min(height - 1, int(std::floor(high.y())));
    const int x0 = std::max(0, int(std::ceil(low.x()))), x1 = std::min(width - 1, int(std::floor(high.x())));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2d d(x - p[0].x(), y - p[0].y());
        const double b = (d.x() * e2.y() - d.y() * e2.x()) / area,
                     c = (e1.x() * d.y() - e1.y() * d.x()) / area;
        constexpr double kEdge = -1e-9;  // samples on an edge belong to both triangles: no gap between them
        if (b < kEdge || c < kEdge || b + c > 1 - kEdge) continue;
        const Eigen::Vector2d at = q[0] + b * (q[1] - q[0]) + c * (q[2] - q[0]);
        samples[std::size_t(y) * std::size_t(width) + std::size_t(x)] = bilinear(texture, at.x(), at.y());
      }
  }
  constexpr int kAll = kSamples * kSamples;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      int covered = 0;
      std::array<int, 3> sum{};
      for (int k = 0; k < kAll; ++k) {
        const auto& s = samples[std::size_t(kSamples * y + k / kSamples) * std::size_t(width) +
                                std::size_t(kSamples * x + k % kSamples)];
        if (s[3] == 0) continue;
        ++covered;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += s[c];
      }
      if (covered == 0) continue;
      // Over what is there, with straight alpha.
      std::uint8_t* out = image.pixel(x, y);
      const double share = double(covered) / kAll, below = out[3] / 255.0 * (1 - share),
                   alpha = share + below;
      for (std::size_t c = 0; c < 3; ++c)
        out[c] = std::uint8_t(std::lround((share * sum[c] / covered + below * out[c]) / alpha));
      out[3] = std::uint8_t(std::lround(255 * alpha));
    }
}

}  // namespace skel
