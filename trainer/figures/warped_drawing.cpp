#include "trainer/figures/warped_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "libskel/core/check.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

// A growing function of [0, 1] onto [0, its last value], linear between equally spaced knots: some stretches
// of the drawing become longer, others shorter.
class Stretch {
 public:
  explicit Stretch(Rng& rng) {
    constexpr double kSpread = .18;  // of the logarithm of a stretch's factor
    const double all = std::exp(rng.normal(0, .1));
    for (std::size_t i = 0; i + 1 < at_.size(); ++i) {
      at_[i + 1] = at_[i] + all * std::exp(rng.normal(0, kSpread)) / kParts;
    }
  }
  double operator()(double t) const {
    const int i = std::clamp(static_cast<int>(std::floor(t * kParts)), 0, kParts - 1);
    return at_[i] + (t * kParts - i) * (at_[i + 1] - at_[i]);
  }
  double inverse(double s) const {
    int i = 0;
    while (i + 1 < kParts && at_[i + 1] <= s) ++i;
    return (i + (s - at_[i]) / (at_[i + 1] - at_[i])) / kParts;
  }

 private:
  static constexpr int kParts = 6;
  std::array<double, kParts + 1> at_{};
};

struct Wave {
  Vec direction, shift;
  double phase;
};

// From the drawing (its long side is 1) to the figure and back. forward: stretches, turn, then bent so that
// q + bend(q) is what was there before.
struct Warp {
  Stretch stretch_x, stretch_y;
  Eigen::Matrix2d turn;
  std::array<Wave, 3> waves{};

  Warp(Rng& rng, double angle) : stretch_x(rng), stretch_y(rng) {
    turn = Eigen::Rotation2Dd(angle + rng.normal(0, rng.chance(.9) ? .08 : .4)).toRotationMatrix();
    const double size = rng.chance(.6) ? rng.uniform(.003, .015) : 0;
    for (Wave& w : waves) {
      w.direction = Eigen::Rotation2Dd(rng.uniform(0, 2 * std::numbers::pi)) * Vec(rng.uniform(3, 9), 0);
      w.shift = Vec(rng.normal(0, size), rng.normal(0, size));
      w.phase = rng.uniform(0, 2 * std::numbers::pi);
    }
  }
  Vec bend(const Vec& q) const {
    Vec sum = Vec::Zero();
    for (const Wave& w : waves) sum += w.shift * std::sin(w.direction.dot(q) + w.phase);
    return sum;
  }
  Vec back(const Vec& q) const {
    const Vec p = turn.transpose() * (q + bend(q));
    return {stretch_x.inverse(p.x()), stretch_y.inverse(p.y())};
  }
  Vec forward(const Vec& p) const {
    const Vec straight = turn * Vec(stretch_x(p.x()), stretch_y(p.y()));
    Vec q = straight;
    for (int i = 0; i < 12; ++i) q = straight - bend(q);
    return q;
  }
};

}  // namespace

SmallDrawing smallDrawing(const Image& image, const Plane8& mask, const std::vector<Vec>& joints,
                          FigureView view) {
  SKEL_CHECK(mask.cols() == image.width && mask.rows() == image.height);
  SKEL_CHECK((mask != 0).any());
  int x0 = image.width, y0 = image.height, x1 = -1, y1 = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (mask(y, x) == 0) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  const double step = static_cast<double>(std::max(x1 - x0, y1 - y0) + 1) / kSmallLongSide;
  const int width = std::max(1, static_cast<int>(std::lround((x1 - x0 + 1) / step)));
  const int height = std::max(1, static_cast<int>(std::lround((y1 - y0 + 1) / step)));
  SmallDrawing out{Image(width, height), Plane8::Zero(height, width), {}, view};
  const GridColours colours = gridColours(image, Vec(x0, y0), 1 / step, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int from_x = std::min(x1, x0 + static_cast<int>((x + .5) * step)),
                from_y = std::min(y1, y0 + static_cast<int>((y + .5) * step));
      out.mask(y, x) = mask(from_y, from_x);
      for (int c = 0; c < 3; ++c)
        out.image.pixel(x, y)[c] = static_cast<std::uint8_t>(std::lround(colours(y * width + x, c)));
      out.image.pixel(x, y)[3] = 255;
    }
  }
  for (const Vec& p : joints) out.joints.push_back((p + Vec::Constant(.5) - Vec(x0, y0)) / step);
  out.view = view;
  return out;
}

WarpedDrawing warpedDrawing(Rng& rng, const SmallDrawing& drawing, double turn, int long_side, int margin) {
  const int rows = static_cast<int>(drawing.mask.rows()), columns = static_cast<int>(drawing.mask.cols());
  const Warp warp(rng, turn);
  const double unit = std::max(rows, columns);
  Vec low = Vec::Constant(1e9), high = Vec::Constant(-1e9);
  for (int y = 0; y < rows; y += 2) {
    for (int x = 0; x < columns; x += 2) {
      if (drawing.mask(y, x) == 0) continue;
      const Vec q = warp.forward(Vec(x + .5, y + .5) / unit);
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
  }
  const double scale = long_side / (high - low).maxCoeff();
  WarpedDrawing out;
  out.width = static_cast<int>(std::ceil((high - low).x() * scale)) + 2 * margin;
  out.height = static_cast<int>(std::ceil((high - low).y() * scale)) + 2 * margin;
  low -= Vec::Constant(margin / scale);
  const std::size_t count = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.solid.assign(count, 0);
  out.colours.assign(count, {255, 255, 255});
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const Vec p = warp.back(low + Vec(x + .5, y + .5) / scale) * unit;
      const int px = static_cast<int>(std::floor(p.x())), py = static_cast<int>(std::floor(p.y()));
      if (px < 0 || py < 0 || px >= columns || py >= rows) continue;
      const std::size_t i = static_cast<std::size_t>(y) * out.width + x;
      out.solid[i] = drawing.mask(py, px) != 0;
      const std::uint8_t* c = drawing.image.pixel(px, py);
      out.colours[i] = {c[0], c[1], c[2]};
    }
  }
  for (const Vec& p : drawing.joints) out.joints.push_back((warp.forward(p / unit) - low) * scale);
  return out;
}

}  // namespace skel
