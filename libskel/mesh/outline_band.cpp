#include "libskel/mesh/outline_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/mesh/ink.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// As shares of the figure's long side.
constexpr double kWidest = 0.045;   // of a line
constexpr double kSpacing = 0.006;  // from sample to sample
// inkLightness().
constexpr double kDarkest = 150;      // a line is darker
constexpr double kContrast = 28;      // and what it encloses lighter by this
constexpr double kLeastShape = 0.12;  // of a triangle, 1 for an equilateral one
// How far a line's inner edge is blurred: a share of its width and px, at most a share of a cell.
constexpr double kSoft = 0.15, kSoftPx = 1.5, kMostSoft = 0.35;

double lightnessAt(const Image& image, const Vector2d& p) {
  const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.height - 1);
  const std::uint8_t* c = image.pixel(x, y);
  return inkLightness(c[0], c[1], c[2]);
}

bool inside(const Plane8& mask, const Vector2d& p) {
  const auto x = std::lround(p.x()), y = std::lround(p.y());
  return x >= 0 && y >= 0 && x < mask.cols() && y < mask.rows() && mask(y, x) != 0;
}

// The width of the dark line that begins at `p` and is crossed along `inwards`; 0: none.
double lineWidth(const Image& image, const Plane8& mask, const Vector2d& p, const Vector2d& inwards,
                 double widest_px) {
  std::vector<double> light;
  const double step = 0.5;
  light.reserve(static_cast<std::size_t>(1.6 * widest_px / step) + 1);
  for (double t = step; t <= 1.6 * widest_px; t += step) {
    const Vector2d at = p + t * inwards;
    if (!inside(mask, at)) break;
    light.push_back(lightnessAt(image, at));
  }
  const auto reach = static_cast<std::size_t>(widest_px / step);
  if (light.size() < 4) return 0;
  // The outermost px may shine like paper; then comes ink.
  const auto darkest = std::min_element(light.begin(), light.begin() + std::min(light.size(), reach / 2 + 2));
  if (*darkest > kDarkest) return 0;
  double lightest = 0;
  for (auto it = darkest; it != light.end(); ++it) lightest = std::max(lightest, *it);
  if (lightest - *darkest < kContrast) return 0;
  const double edge = 0.5 * (*darkest + lightest);
  for (auto it = darkest; it != light.end(); ++it) {
    if (*it < edge) continue;
    const auto width = static_cast<std::size_t>(it - light.begin());
    // The body goes on for as much again: else this is a thin thing whose other outline follows.
    const bool body_follows = light.size() > width + width / 2 + 2;
    return width <= reach && body_follows ? (static_cast<double>(width) + 1) * step : 0;
  }
  return 0;
}

// 1 for an equilateral triangle, as it is turned in the drawing; negative for an inverted one.
double shape(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double area = (c.x() - a.x()) * (b.y() - a.y()) - (b.x() - a.x()) * (c.y() - a.y());
  return 2 * std::sqrt(3.0) * area / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

}  // namespace

std::vector<OutlineSample> drawnOutline(const Image& image, const Plane8& mask,
                                        const std::vector<std::vector<Vector2d>>& outline) {
  const PixelBox box = figureBox(mask);
  const double long_side = std::max(box.width(), box.height());
  const int spacing = std::max(1, static_cast<int>(kSpacing * long_side));
  std::vector<OutlineSample> samples;
  for (const auto& curve : outline) {
    const int count = static_cast<int>(curve.size());
    const int span = std::clamp(static_cast<int>(0.01 * long_side), 2, std::max(2, count / 6));
    const std::size_t first = samples.size();
    for (int i = 0; i < count; i += spacing) {
      const Vector2d along = curve[(i + span) % count] - curve[(i + count - span % count) % count];
      OutlineSample sample{curve[i], 0};
      if (along.norm() > 0) {
        const Vector2d inwards = Vector2d(-along.y(), along.x()).normalized();
        sample.width_px = lineWidth(image, mask, curve[i], inwards, kWidest * long_side);
      }
      samples.push_back(sample);
    }
    // One odd look changes nothing: the median of five along the curve.
    std::vector<double> widths;
    for (std::size_t k = first; k < samples.size(); ++k) widths.push_back(samples[k].width_px);
    const int size = static_cast<int>(widths.size());
    for (int k = 0; k < size && size >= 5; ++k) {
      double five[5];
      for (int d = -2; d <= 2; ++d) five[d + 2] = widths[(k + d + size) % size];
      std::nth_element(five, five + 2, five + 5);
      samples[first + k].width_px = five[2];
    }
  }
  return samples;
}

OutlineBand outlineBand(PlanarMesh& mesh, const std::vector<OutlineSample>& outline) {
  OutlineBand band{std::vector<double>(mesh.inner_count, 0), {}};
  double widest = 0;
  for (const OutlineSample& sample : outline) widest = std::max(widest, sample.width_px);
  if (widest == 0) {
    band.drawn = mesh.vertices;
    return band;
  }
  // Samples by cells, so that each vertex looks at its neighbourhood alone.
  const double reach = widest + 1.5 * mesh.cell_px, cell = std::max(reach, 1.0);
  Vector2d low = mesh.vertices.front(), high = low;
  for (const Vector2d& p : mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  low.array() -= cell;
  const int columns = static_cast<int>((high.x() - low.x()) / cell) + 3;
  const int rows = static_cast<int>((high.y() - low.y()) / cell) + 3;
  std::vector<std::vector<int>> cells(static_cast<std::size_t>(columns) * rows);
  const auto cellOf = [&](const Vector2d& p) {
    return std::pair{std::clamp(static_cast<int>((p.x() - low.x()) / cell), 0, columns - 1),
                     std::clamp(static_cast<int>((p.y() - low.y()) / cell), 0, rows - 1)};
  };
  for (std::size_t s = 0; s < outline.size(); ++s) {
    const auto [i, j] = cellOf(outline[s].point);
    cells[static_cast<std::size_t>(j) * columns + i].push_back(static_cast<int>(s));
  }
  std::vector<std::vector<int>> around(mesh.inner_count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t])
      if (v < mesh.inner_count) around[v].push_back(static_cast<int>(t));
  const auto worst = [&](int v) {
    double result = 1;
    for (const int t : around[v]) {
      const auto& [a, b, c] = mesh.triangles[t];
      result = std::min(result, shape(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    }
    return result;
  };
  std::vector<Vector2d> inwards(mesh.inner_count, Vector2d::Zero());
  for (int v = 0; v < mesh.inner_count; ++v) {
    const Vector2d p = mesh.vertices[v];
    const auto [ci, cj] = cellOf(p);
    double distance = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (int j = std::max(0, cj - 1); j <= std::min(rows - 1, cj + 1); ++j)
      for (int i = std::max(0, ci - 1); i <= std::min(columns - 1, ci + 1); ++i)
        for (const int s : cells[static_cast<std::size_t>(j) * columns + i])
          if (const double d = (outline[s].point - p).norm(); d < distance) distance = d, nearest = s;
    if (nearest < 0 || outline[nearest].width_px == 0 || distance == 0) continue;
    const double width = outline[nearest].width_px;
    if (std::abs(distance - width) < 0.75 * mesh.cell_px) {
      const Vector2d q = outline[nearest].point;
      const double before = worst(v);
      for (const double share : {1.0, 0.6, 0.3}) {
        const double target = distance + share * (width - distance);
        mesh.vertices[v] = q + (p - q) * (target / distance);
        if (worst(v) >= std::min(before, kLeastShape)) {
          distance = target;
          break;
        }
        mesh.vertices[v] = p;
      }
    }
    if (distance > width + 0.08 * mesh.cell_px) continue;
    band.width_px[v] = width;
    const double soft = std::min(kSoft * width + kSoftPx, kMostSoft * mesh.cell_px);
    inwards[v] = (p - outline[nearest].point).normalized() * (soft * std::min(1.0, distance / width));
  }
  band.drawn = mesh.vertices;
  for (int v = 0; v < mesh.inner_count; ++v) band.drawn[v] += inwards[v];
  return band;
}

}  // namespace skel
