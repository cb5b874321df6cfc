// A. Telea, "An image inpainting technique based on the fast marching method" (2004), without its gradients:
// the front moves inwards in steps of one pixel, each new pixel a mean of the known ones around it that
// counts near ones more, and so do those of a colour like the nearest's: areas of flat colour stay flat.
#include "libskel/mesh/fill_hidden.h"

#include <algorithm>
#include <vector>

#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr int kReach = 3;   // px
constexpr int kAlike = 48;  // largest difference of a channel

bool alike(const std::uint8_t* a, const std::uint8_t* b) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(int(a[c]) - int(b[c])) > kAlike) return false;
  return true;
}

}  // namespace

Image fillHidden(const Image& image, const Plane8& known, const Plane8& hidden) {
  SKEL_CHECK_EQ(known.rows(), image.height);
  SKEL_CHECK_EQ(hidden.cols(), image.width);
  Image filled = image;
  enum : std::uint8_t { kOther, kKnown, kWanted, kWaiting };
  Plane8 state =
      (hidden != 0)
          .select(Plane8::Constant(hidden.rows(), hidden.cols(), kWanted), (known != 0).cast<std::uint8_t>());
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const auto within = [&](int x, int y) { return x >= 0 && y >= 0 && x < image.width && y < image.height; };
  struct Pixel {
    int x, y;
  };
  std::vector<Pixel> front, next;
  const auto spread = [&](int x, int y, std::vector<Pixel>& to) {
    for (const auto& step : kSteps) {
      const int u = x + step[0], v = y + step[1];
      if (!within(u, v) || state(v, u) != kWanted) continue;
      state(v, u) = kWaiting;
      to.push_back({u, v});
    }
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (state(y, x) == kKnown) spread(x, y, front);
  while (!front.empty()) {
    for (const Pixel& p : front) {
      const std::uint8_t* nearest = nullptr;
      int least = 3 * kReach * kReach;
      const auto forKnown = [&](const auto& visit) {
        for (int v = p.y - kReach; v <= p.y + kReach; ++v)
          for (int u = p.x - kReach; u <= p.x + kReach; ++u)
            if (within(u, v) && state(v, u) == kKnown)
              visit(filled.pixel(u, v), (u - p.x) * (u - p.x) + (v - p.y) * (v - p.y));
      };
      forKnown([&](const std::uint8_t* c, int distance2) {
        if (distance2 < least) least = distance2, nearest = c;
      });
      int sum[4] = {0, 0, 0, 0}, weights = 0;
      forKnown([&](const std::uint8_t* c, int distance2) {
        if (!alike(c, nearest)) return;
        const int weight = 64 / distance2;
        for (int k = 0; k < 4; ++k) sum[k] += weight * c[k];
        weights += weight;
      });
      for (int k = 0; k < 4; ++k)
        filled.pixel(p.x, p.y)[k] = static_cast<std::uint8_t>((sum[k] + weights / 2) / weights);
    }
    // Known from the next step on, so that the order within a step does not matter.
    next.clear();
    for (const Pixel& p : front) state(p.y, p.x) = kKnown;
    for (const Pixel& p : front) spread(p.x, p.y, next);
    front.swap(next);
  }
  return filled;
}

}  // namespace skel
