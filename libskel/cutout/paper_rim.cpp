#include "libskel/cutout/paper_rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using GroundColor = std::array<int, 3>;

constexpr double kRim = 0.015;  // of the figure's long side: paper that lies deeper is what the lines enclose
constexpr double kAround = 0.02;  // of it: so far from the figure the ground is looked at
constexpr double kEven = 0.8;     // of that ground has the colour that it is taken to have
constexpr int kPaper = 24;        // from the ground's colour, of 255, the most of the three

constexpr double kSlit = 0.007;  // of it: half of how wide a slit is that a brush has left in a mask

// What is no figure, but for slits.
Plane8 groundOf(const Plane8& mask, const DistanceField& outside, double half_slit) {
  const Plane8 wider = (mask != 0 || outside <= float(half_slit)).cast<std::uint8_t>();
  const DistanceField within = distanceField(wider);
  return (mask == 0 && within <= float(half_slit)).cast<std::uint8_t>();
}

int apart(const std::uint8_t* p, const GroundColor& color) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(p[c]) - color[c]));
  return most;
}

// The colour of opaque pixels near the figure, if it is one.
std::optional<GroundColor> groundAround(const Image& image, const Plane8& mask, const DistanceField& outside,
                                        int reach) {
  std::array<std::vector<std::uint8_t>, 3> seen;
  std::vector<const std::uint8_t*> ring;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (mask(y, x) == 0 && outside(y, x) <= float(reach)) ring.push_back(image.pixel(x, y));
  if (ring.empty() ||
      std::any_of(ring.begin(), ring.end(), [](const std::uint8_t* p) { return p[3] != 255; }))
    return std::nullopt;
  GroundColor ground{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const std::uint8_t* p : ring) seen[c].push_back(p[c]);
    const auto middle = seen[c].begin() + std::ptrdiff_t(seen[c].size() / 2);
    std::nth_element(seen[c].begin(), middle, seen[c].end());
    ground[c] = *middle;
  }
  const auto like = std::count_if(ring.begin(), ring.end(),
                                  [&](const std::uint8_t* p) { return apart(p, ground) <= kPaper; });
  if (double(like) < kEven * double(ring.size())) return std::nullopt;
  return ground;
}

// From which contrast on nothing of the ground shines through: pencil is fainter than ink.
double lineContrast(const Image& image, const Plane8& rim, const GroundColor& ground) {
  constexpr double kLeast = 40, kMost = 96;
  std::vector<int> contrasts;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (rim(y, x) != 0)
        if (const int contrast = apart(image.pixel(x, y), ground); contrast > kPaper)
          contrasts.push_back(contrast);
  if (contrasts.empty()) return kMost;
  const auto middle = contrasts.begin() + std::ptrdiff_t(contrasts.size() / 2);
  std::nth_element(contrasts.begin(), middle, contrasts.end());
  return std::clamp(double(*middle), kLeast, kMost);
}

}  // namespace

Image withoutPaperRim(Image image, const Silhouette& silhouette) {
  const Plane8& mask = silhouette.mask;
  const PixelBox box = figureBox(mask);
  const double long_side = std::max(box.width(), box.height());
  const DistanceField away = distanceField((mask == 0).cast<std::uint8_t>());
  const std::optional<GroundColor> ground =
      groundAround(image, mask, away, std::max(2, int(std::lround(kAround * long_side))));
  if (!ground) return image;

  // Paper from the silhouette's edge inwards.
  const float deepest = float(std::max(2., kRim * long_side));
  const Plane8 outside = groundOf(mask, away, kSlit * long_side);
  const DistanceField inside = distanceField((mask != 0).cast<std::uint8_t>());
  Plane8 rim = Plane8::Zero(mask.rows(), mask.cols());
  std::vector<Eigen::Vector2i> stack;
  const auto reach = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height || rim(y, x) != 0) return;
    if (mask(y, x) == 0 || inside(y, x) > deepest) return;
    rim(y, x) = 1;  // lines end it, and are looked at as well
    if (apart(image.pixel(x, y), *ground) <= kPaper) stack.emplace_back(x, y);
  };
  constexpr std::array<std::array<int, 2>, 4> kSteps{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (outside(y, x) != 0)
        for (const auto& [dx, dy] : kSteps) reach(x + dx, y + dy);
  while (!stack.empty()) {
    const Eigen::Vector2i p = stack.back();
    stack.pop_back();
    for (const auto& [dx, dy] : kSteps) reach(p.x() + dx, p.y() + dy);
  }
  const double line_contrast = lineContrast(image, rim, *ground);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (rim(y, x) == 0) continue;
      std::uint8_t* p = image.pixel(x, y);
      const double line = std::clamp(double(apart(p, *ground)) / line_contrast, 0., 1.);
      if (line > 0)
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = std::uint8_t(std::clamp((*ground)[c] + (p[c] - (*ground)[c]) / line, 0., 255.) + 0.5);
      p[3] = std::uint8_t(std::lround(line * p[3]));
    }
  return image;
}

}  // namespace skel
