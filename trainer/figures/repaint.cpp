#include "trainer/figures/repaint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace skel {
namespace {

Eigen::Array3f sampleColour(Rng& rng, double low, double high) {
  return {static_cast<float>(rng.uniform(low, high)), static_cast<float>(rng.uniform(low, high)),
          static_cast<float>(rng.uniform(low, high))};
}

// Each channel becomes a random curve of a random mixture of the three: what had one colour has one again.
void changePalette(Rng& rng, GridColours& colours) {
  constexpr int kKnots = 6;
  GridColours out(colours.rows(), 3);
  for (int channel = 0; channel < 3; ++channel) {
    Eigen::Array3f mixture = sampleColour(rng, 0, 1);
    mixture /= mixture.sum() * 255 / (kKnots - 1);
    std::array<float, kKnots> curve;
    for (float& value : curve) value = static_cast<float>(rng.uniform(0, 255));
    for (int i = 0; i < colours.rows(); ++i) {
      const float t = std::clamp((colours.row(i).transpose() * mixture).sum(), 0.f, kKnots - 1.001f);
      const auto knot = static_cast<std::size_t>(t);
      out(i, channel) = curve[knot] + (t - static_cast<float>(knot)) * (curve[knot + 1] - curve[knot]);
    }
  }
  colours = out;
}

// Where colours change there is a line, and nothing between the lines but what was black.
void leaveLines(Rng& rng, const Plane8& mask, GridColours& colours) {
  const Plane8 lines = lineStrength(colours, mask);
  const bool on_dark = rng.chance(.15), outlined = rng.chance(.7), keep_black = rng.chance(.5);
  const Eigen::Array3f paper = on_dark ? sampleColour(rng, 0, 90) : sampleColour(rng, 200, 255),
                       ink = on_dark ? sampleColour(rng, 180, 255) : sampleColour(rng, 0, 110);
  const auto pressure = static_cast<float>(rng.uniform(.8, 2.5));
  const auto inside = [&](int y, int x) {
    return y >= 0 && x >= 0 && y < mask.rows() && x < mask.cols() && mask(y, x) != 0;
  };
  for (int y = 0; y < mask.rows(); ++y) {
    for (int x = 0; x < mask.cols(); ++x) {
      auto colour = colours.row(y * mask.cols() + x);
      float share = std::min(1.f, pressure * static_cast<float>(lines(y, x)) / 255);
      if (outlined && !(inside(y - 1, x) && inside(y + 1, x) && inside(y, x - 1) && inside(y, x + 1)))
        share = 1;
      if (keep_black && colour.mean() < 60) share = 1;
      colour = (paper + share * (ink - paper)).transpose();
    }
  }
}

// Parallel strokes over all of the figure, a round part of it, or its shades.
void hatch(Rng& rng, const Plane8& mask, GridColours& colours) {
  const double angle = rng.uniform(0, std::numbers::pi), spacing = rng.uniform(2.5, 8),
               wide = spacing * rng.uniform(.2, .5), where = rng.uniform();
  const Eigen::Vector2d across(std::cos(angle), std::sin(angle)),
      centre(rng.uniform(0, static_cast<double>(mask.cols())),
             rng.uniform(0, static_cast<double>(mask.rows())));
  const double radius = rng.uniform(15, 60), darkest = rng.uniform(60, 180);
  const Eigen::Array3f ink = sampleColour(rng, 0, rng.chance(.8) ? 100 : 255);
  const auto strength = static_cast<float>(rng.uniform(.3, 1));
  for (int y = 0; y < mask.rows(); ++y) {
    for (int x = 0; x < mask.cols(); ++x) {
      const Eigen::Vector2d p(x, y);
      auto colour = colours.row(y * mask.cols() + x);
      if (where < .4 ? (p - centre).norm() > radius : where < .8 && colour.mean() > darkest) continue;
      const double at = p.dot(across) / spacing;
      if ((at - std::floor(at)) * spacing > wide) continue;
      colour += strength * (ink.transpose() - colour);
    }
  }
}

// Light and dark patches, as watercolours, crumpled paper and cloth have them.
void blotch(Rng& rng, const Plane8& mask, GridColours& colours) {
  const auto depth = static_cast<float>(rng.uniform(.08, .35));
  struct Wave {
    Eigen::Vector2d direction;
    double phase;
    Eigen::Array3f weight;
  };
  std::array<Wave, 4> waves;
  for (Wave& wave : waves) {
    const double angle = rng.uniform(0, 2 * std::numbers::pi), length = rng.uniform(8, 50);
    wave.direction = Eigen::Vector2d(std::cos(angle), std::sin(angle)) * (2 * std::numbers::pi / length);
    wave.phase = rng.uniform(0, 2 * std::numbers::pi);
    wave.weight = depth * sampleColour(rng, .4, 1);
  }
  for (int y = 0; y < mask.rows(); ++y) {
    for (int x = 0; x < mask.cols(); ++x) {
      Eigen::Array3f factor = Eigen::Array3f::Ones();
      for (const Wave& wave : waves)
        factor += wave.weight *
                  static_cast<float>(std::sin(wave.direction.dot(Eigen::Vector2d(x, y)) + wave.phase));
      auto colour = colours.row(y * mask.cols() + x);
      colour = (colour * factor.max(.1f).transpose()).min(255.f);
    }
  }
}

}  // namespace

void repaint(Rng& rng, const Plane8& mask, GridColours& colours) {
  const double kind = rng.uniform();
  if (kind < .25)
    changePalette(rng, colours);
  else if (kind < .42)
    leaveLines(rng, mask, colours);
  if (rng.chance(.12)) hatch(rng, mask, colours);
  if (rng.chance(.18)) blotch(rng, mask, colours);
}

}  // namespace skel
