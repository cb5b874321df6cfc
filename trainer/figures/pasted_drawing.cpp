#include "trainer/figures/pasted_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr std::size_t kMostCovered = 4;  // joints, by one thing

struct Cutting {
  WarpedDrawing drawing;
  int x0, y0, x1, y1;  // what is left of it, px; x1, y1 excluded
  bool round = false;  // an ellipse in this box

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  // Index of the px at (u, v) from the corner of the box, -1: nothing is there.
  std::ptrdiff_t at(int u, int v) const {
    if (u < 0 || v < 0 || u >= width() || v >= height()) return -1;
    if (round && Vec(2. * u / width() - 1, 2. * v / height() - 1).squaredNorm() > 1) return -1;
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(y0 + v) * drawing.width + x0 + u;
    return drawing.solid[static_cast<std::size_t>(i)] ? i : -1;
  }
};

Cutting sampleCutting(Rng& rng, const SmallDrawing& drawing, int long_side) {
  Cutting cutting{warpedDrawing(rng, drawing, rng.uniform(0, 2 * std::numbers::pi), long_side, 0),
                  0,
                  0,
                  0,
                  0,
                  rng.chance(.3)};
  const auto stretch = [&](int size) {
    const double share = rng.uniform(.35, 1);
    const int from = static_cast<int>(size * (1 - share) * rng.uniform());
    return std::pair(from, std::min(size, from + std::max(1, static_cast<int>(size * share))));
  };
  std::tie(cutting.x0, cutting.x1) = stretch(cutting.drawing.width);
  std::tie(cutting.y0, cutting.y1) = stretch(cutting.drawing.height);
  return cutting;
}

void paste(const Cutting& cutting, int left, int top, bool in_front, WarpedDrawing& figure) {
  for (int y = std::max(0, top); y < std::min(figure.height, top + cutting.height()); ++y) {
    for (int x = std::max(0, left); x < std::min(figure.width, left + cutting.width()); ++x) {
      const std::ptrdiff_t from = cutting.at(x - left, y - top);
      const std::size_t to = static_cast<std::size_t>(y) * figure.width + x;
      if (from < 0 || (figure.solid[to] && !in_front)) continue;
      figure.solid[to] = 1;
      figure.colours[to] = cutting.drawing.colours[static_cast<std::size_t>(from)];
    }
  }
}

}  // namespace

void pasteThing(Rng& rng, const FigurePlan& plan, const SmallDrawing& drawing, int long_side,
                WarpedDrawing& figure, std::vector<bool>& visible) {
  const Cutting thing = sampleCutting(rng, drawing, static_cast<int>(long_side * rng.uniform(.12, .5)));
  const bool in_front = rng.chance(.5), at_end = rng.chance(.6);
  std::size_t joint = 0;
  do {
    joint = rng.below(static_cast<std::uint32_t>(plan.joints.size()));
  } while (plan.joints[joint].end != at_end);
  const double spread = .05 * long_side;
  const Vec middle = figure.joints[joint] + spread * Vec(rng.normal(), rng.normal());
  const int left = static_cast<int>(middle.x()) - thing.width() / 2,
            top = static_cast<int>(middle.y()) - thing.height() / 2;
  std::vector<std::size_t> covered;
  for (std::size_t j = 0; in_front && j < figure.joints.size(); ++j) {
    const auto x = static_cast<int>(figure.joints[j].x()), y = static_cast<int>(figure.joints[j].y());
    if (thing.at(x - left, y - top) >= 0) covered.push_back(j);
  }
  if (covered.size() > kMostCovered) return;
  for (const std::size_t j : covered) visible[j] = false;
  paste(thing, left, top, in_front, figure);
}

void pasteNeighbour(Rng& rng, const SmallDrawing& drawing, int long_side, WarpedDrawing& figure) {
  Cutting other{warpedDrawing(rng, drawing, 0, static_cast<int>(long_side * rng.uniform(.65, 1)), 0), 0, 0, 0,
                0};
  other.x1 = other.drawing.width;
  other.y1 = other.drawing.height;
  int x0 = figure.width, x1 = 0, y1 = 0;
  for (int y = 0; y < figure.height; ++y) {
    for (int x = 0; x < figure.width; ++x) {
      if (!figure.solid[static_cast<std::size_t>(y) * figure.width + x]) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x + 1), y1 = std::max(y1, y + 1);
    }
  }
  const auto overlap = static_cast<int>(rng.uniform(.05, .4) * std::min(x1 - x0, other.width()));
  const int left = rng.chance(.5) ? x1 - overlap : x0 + overlap - other.width();
  const int top = y1 - other.height() + static_cast<int>(.05 * long_side * rng.normal());
  paste(other, left, top, rng.chance(.5), figure);
}

}  // namespace skel
