#include "libskel/mesh/outline_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "libskel/mesh/cut_mesh.h"
#include "libskel/mesh/ink.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// As shares of the figure's long side.
constexpr double kWidest = 0.045;   // of a line
constexpr double kSpacing = 0.006;  // from sample to sample
// inkLightness().
constexpr double kDarkest = 150;  // a line is darker,
constexpr double kFaint = 60;     // or, in pink or yellow, by this much darker than what it encloses
constexpr double kContrast = 28;  // and what it encloses lighter by this
constexpr double kShareOfLight = 0.35, kLeastContrast = 15;  // or, where that is dark, by this share of it
constexpr double kWhite = 215, kWhiteContrast = 90;  // or it is as light, and what it encloses so much darker
// As shares of the widest: less is paper that shines through, more is a hood or a collar.
constexpr double kLeastWhite = 0.12, kMostWhite = 0.65;
constexpr double kLeastShape = 0.12;  // of a triangle, 1 for an equilateral one
constexpr double kGap = 5;            // widths of an outline along which it may be lost
// How far a line's inner edge is blurred: a share of its width and px, at most a share of a cell.
constexpr double kSoft = 0.15, kSoftPx = 1.5, kMostSoft = 0.35;

// Nothing outside of the figure.
std::optional<double> lightnessAt(const Image& image, const Plane8& mask, const Vector2d& p) {
  const auto x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || mask(y, x) == 0) return std::nullopt;
  const std::uint8_t* c = image.pixel(x, y);
  return inkLightness(c[0], c[1], c[2]);
}

constexpr double kStep = 0.5;  // px, from value to value

// The width of a line whose values are below those of what it encloses, at most `reach` steps, px; 0: none.
// `is_line`: by the line's darkest value and the lightest of what it encloses.
template <class IsLine>
double lineWidth(const std::vector<double>& light, std::size_t reach, const IsLine& is_line) {
  // The outermost px may shine like paper; then comes ink.
  const auto darkest = std::min_element(
      light.begin(), light.begin() + static_cast<std::ptrdiff_t>(std::min(light.size(), reach / 2 + 2)));
  const double lightest = *std::max_element(darkest, light.end());
  if (!is_line(*darkest, lightest)) return 0;
  const auto edge =
      std::find_if(darkest, light.end(), [&](double value) { return value >= 0.5 * (*darkest + lightest); });
  const auto width = static_cast<std::size_t>(edge - light.begin());
  // The body goes on for as much again: else this is a thin thing whose other outline follows.
  const bool body_follows = light.size() > width + width / 2 + 2;
  return width <= reach && body_follows ? (static_cast<double>(width) + 1) * kStep : 0;
}

// The line that begins at sample.point and is crossed along sample.inwards.
void findLine(const Image& image, const Plane8& mask, double widest_px, OutlineSample& sample) {
  const auto samples = static_cast<std::size_t>(1.6 * widest_px / kStep);
  std::vector<double> light;
  light.reserve(samples);
  for (std::size_t i = 1; i <= samples; ++i) {
    const auto here =
        lightnessAt(image, mask, sample.point + static_cast<double>(i) * kStep * sample.inwards);
    if (!here) break;
    light.push_back(*here);
  }
  const auto reach = static_cast<std::size_t>(widest_px / kStep);
  if (light.size() < 4) return;
  sample.width_px = lineWidth(light, reach, [](double darkest, double lightest) {
    return darkest <= std::max(kDarkest, lightest - kFaint) &&
           lightest - darkest >= std::clamp(kShareOfLight * lightest, kLeastContrast, kContrast);
  });
  // Paper shines through strokes of crayon: only what is wide can have a white outline.
  if (sample.width_px > 0 || light.size() < samples) return;
  for (double& value : light) value = 255 - value;
  const double white = lineWidth(light, reach, [](double darkest, double lightest) {
    return darkest <= 255 - kWhite && lightest - darkest >= kWhiteContrast;
  });
  if (white < kLeastWhite * widest_px || white > kMostWhite * widest_px) return;
  sample.width_px = white;
  sample.light = true;
}

// 1 for an equilateral triangle, as it is turned in the drawing; negative for an inverted one.
double shape(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double area = (c.x() - a.x()) * (b.y() - a.y()) - (b.x() - a.x()) * (c.y() - a.y());
  return 2 * std::sqrt(3.0) * area / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

// Where another line meets the outline, that goes on: it is told from both sides of a gap of at most
// kGap widths. `samples` from `first` on are one closed curve.
void closeGaps(std::vector<OutlineSample>& samples, std::size_t first, int spacing_px) {
  const int size = static_cast<int>(samples.size() - first);
  const auto width = [&](int k) -> double& { return samples[first + (k % size)].width_px; };
  for (int k = 0; k < size; ++k) {
    if (width(k) == 0 || width(k + 1) > 0) continue;
    int end = k + 1;
    while (end < k + size && width(end) == 0) ++end;
    const double before = width(k), after = width(end);
    if ((end - k) * spacing_px > kGap * (before + after) / 2) continue;
    for (int i = k + 1; i < end; ++i) {
      width(i) = before + (after - before) * (i - k) / (end - k);
      samples[first + (i % size)].light = samples[first + (k % size)].light;
    }
  }
}

// The outline's samples by cells, so that each vertex looks at its neighbourhood alone.
class SampleGrid {
 public:
  SampleGrid(const PlanarMesh& mesh, const std::vector<OutlineSample>& outline, double reach)
      : outline_(outline), cell_(std::max(reach, 1.0)), low_(mesh.vertices.front()) {
    Vector2d high = low_;
    for (const Vector2d& p : mesh.vertices) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
    low_.array() -= cell_;
    columns_ = static_cast<int>((high.x() - low_.x()) / cell_) + 3;
    rows_ = static_cast<int>((high.y() - low_.y()) / cell_) + 3;
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (std::size_t s = 0; s < outline.size(); ++s) {
      const auto [i, j] = cellOf(outline[s].point);
      cells_[static_cast<std::size_t>(j) * columns_ + i].push_back(static_cast<int>(s));
    }
  }

  // Null: none is within reach.
  const OutlineSample* nearest(const Vector2d& p) const {
    const auto [ci, cj] = cellOf(p);
    double distance = std::numeric_limits<double>::infinity();
    const OutlineSample* found = nullptr;
    for (int j = std::max(0, cj - 1); j <= std::min(rows_ - 1, cj + 1); ++j)
      for (int i = std::max(0, ci - 1); i <= std::min(columns_ - 1, ci + 1); ++i)
        for (const int s : cells_[static_cast<std::size_t>(j) * columns_ + i])
          if (const double d = (outline_[s].point - p).norm(); d < distance)
            distance = d, found = &outline_[s];
    return found;
  }

 private:
  std::pair<int, int> cellOf(const Vector2d& p) const {
    return {std::clamp(static_cast<int>((p.x() - low_.x()) / cell_), 0, columns_ - 1),
            std::clamp(static_cast<int>((p.y() - low_.y()) / cell_), 0, rows_ - 1)};
  }

  const std::vector<OutlineSample>& outline_;
  double cell_;
  Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

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
      OutlineSample sample{curve[i]};
      if (along.norm() > 0) {
        sample.inwards = Vector2d(-along.y(), along.x()).normalized();
        findLine(image, mask, kWidest * long_side, sample);
      }
      samples.push_back(sample);
    }
    // One odd look changes nothing: the one of median width among five along the curve.
    const std::vector<OutlineSample> found(samples.begin() + std::ptrdiff_t(first), samples.end());
    const int size = static_cast<int>(found.size());
    for (int k = 0; k < size && size >= 5; ++k) {
      std::pair<double, bool> five[5];
      for (int d = -2; d <= 2; ++d) {
        const OutlineSample& sample = found[static_cast<std::size_t>((k + d + size) % size)];
        five[d + 2] = {sample.width_px, sample.light};
      }
      std::nth_element(five, five + 2, five + 5);
      std::tie(samples[first + k].width_px, samples[first + k].light) = five[2];
    }
    closeGaps(samples, first, spacing);
  }
  return samples;
}

OutlineBand outlineBand(PlanarMesh& mesh, const std::vector<OutlineSample>& outline) {
  OutlineBand band{std::vector<double>(mesh.inner_count, 0), std::vector<bool>(mesh.inner_count, false),
                   mesh.vertices, mesh.vertices};
  band.ink.resize(band.width_px.size());
  double widest = 0;
  for (const OutlineSample& sample : outline) widest = std::max(widest, sample.width_px);
  if (widest == 0) return band;
  const double reach = widest + 1.5 * mesh.cell_px;
  const SampleGrid samples(mesh, outline, reach);
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
  const auto softOf = [&](double width) {
    return std::min(kSoft * width + kSoftPx, kMostSoft * mesh.cell_px);
  };
  std::vector<Vector2d> inwards(mesh.inner_count, Vector2d::Zero());
  // How far behind the line's inner edge each vertex lies.
  std::vector<double> behind(mesh.vertices.size(), reach);
  for (int v = 0; v < mesh.inner_count; ++v) {
    const Vector2d p = mesh.vertices[v];
    const OutlineSample* nearest = samples.nearest(p);
    if (nearest == nullptr) continue;
    const Vector2d q = nearest->point;
    const double width = nearest->width_px;
    double distance = (p - q).norm();
    behind[v] = distance - width;
    if (width == 0 || distance == 0) continue;
    if (std::abs(distance - width) < 0.75 * mesh.cell_px) {
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
    behind[v] = distance - width;
    if (behind[v] > 0.08 * mesh.cell_px) continue;
    behind[v] = std::min(behind[v], 0.0);
    band.width_px[v] = width;
    band.light[v] = nearest->light;
    band.ink[v] = q + (p - q) * (width / 2 / (p - q).norm());
    inwards[v] = (p - q).normalized() * (softOf(width) * std::min(1.0, distance / width));
  }
  for (std::size_t v = static_cast<std::size_t>(mesh.inner_count); v < mesh.vertices.size(); ++v) {
    const OutlineSample* nearest = samples.nearest(mesh.vertices[v]);
    behind[v] = nearest == nullptr ? 0 : -nearest->width_px;
  }
  // What is left of the line's inner edge crosses triangles.
  for (const CutVertex& cut : cutMesh(mesh, behind)) {
    const Vector2d& a = mesh.vertices[cut.a];
    const OutlineSample* nearest = samples.nearest(a);
    const double width = nearest == nullptr ? 0 : nearest->width_px;
    const Vector2d along = mesh.vertices[cut.b] - a;
    band.width_px.push_back(width);
    band.light.push_back(nearest != nullptr && nearest->light);
    band.ink.push_back(a + (mesh.vertices[band.ink.size()] - a) / 2);
    inwards.push_back(along * std::min(softOf(width) / along.norm(), (1 - cut.t) / 2));
  }
  band.drawn = mesh.vertices;
  for (int v = 0; v < mesh.inner_count; ++v) band.drawn[v] += inwards[v];
  return band;
}

}  // namespace skel
