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

Image fillHidden(Image image, const Plane8& known, const Plane8& hidden) {
  SKEL_CHECK_EQ(known.rows(), image.height);
  SKEL_CHECK_EQ(hidden.cols(), image.width);
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
      struct Known {
        const std::uint8_t* color;
        int distance2;
      };
      Known around[(2 * kReach + 1) * (2 * kReach + 1)];
      int count = 0, nearest = 0;
      for (int v = std::max(0, p.y - kReach); v <= std::min(image.height - 1, p.y + kReach); ++v)
        for (int u = std::max(0, p.x - kReach); u <= std::min(image.width - 1, p.x + kReach); ++u) {
          if (state(v, u) != kKnown) continue;
          around[count] = {image.pixel(u, v), (u - p.x) * (u - p.x) + (v - p.y) * (v - p.y)};
          if (around[count].distance2 < around[nearest].distance2) nearest = count;
          ++count;
        }
      int sum[4] = {0, 0, 0, 0}, weights = 0;
      for (int i = 0; i < count; ++i) {
        if (!alike(around[i].color, around[nearest].color)) continue;
        const int weight = 64 / around[i].distance2;
        for (int k = 0; k < 4; ++k) sum[k] += weight * around[i].color[k];
        weights += weight;
      }
      for (int k = 0; k < 4; ++k)
        image.pixel(p.x, p.y)[k] = static_cast<std::uint8_t>((sum[k] + weights / 2) / weights);
    }
    // Known from the next step on, so that the order within a step does not matter.
    next.clear();
    for (const Pixel& p : front) state(p.y, p.x) = kKnown;
    for (const Pixel& p : front) spread(p.x, p.y, next);
    front.swap(next);
  }
  return image;
}

}  // namespace skel
