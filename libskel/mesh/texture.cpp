// S. Gortler, R. Grzeszczuk, R. Szeliski, M. Cohen, "The lumigraph" (1996), section 3.4: pull-push.
#include "libskel/mesh/texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace skel {
namespace {

constexpr int kMargin = kTextureMargin;

// Alpha is 255 where the colour is known, 0 where it is not.
void pullPush(Image& image) {
  std::vector<Image> levels;
  const Image* fine = &image;
  while (fine->width > 1 || fine->height > 1) {
    Image coarse((fine->width + 1) / 2, (fine->height + 1) / 2);
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        int sum[3] = {0, 0, 0}, count = 0;
        for (int v = 2 * y; v < std::min(2 * y + 2, fine->height); ++v) {
          for (int u = 2 * x; u < std::min(2 * x + 2, fine->width); ++u) {
            const std::uint8_t* p = fine->pixel(u, v);
            if (p[3] == 0) continue;
            sum[0] += p[0], sum[1] += p[1], sum[2] += p[2], ++count;
          }
        }
        std::uint8_t* p = coarse.pixel(x, y);
        for (int c = 0; c < 3; ++c)
          p[c] = count ? static_cast<std::uint8_t>((sum[c] + count / 2) / count) : 0;
        p[3] = count ? 255 : 0;
      }
    }
    levels.push_back(std::move(coarse));
    fine = &levels.back();
  }
  for (std::size_t level = levels.size(); level-- > 0;) {
    Image& target = level == 0 ? image : levels[level - 1];
    for (int y = 0; y < target.height; ++y) {
      for (int x = 0; x < target.width; ++x) {
        std::uint8_t* p = target.pixel(x, y);
        if (p[3] == 0) std::copy_n(levels[level].pixel(x / 2, y / 2), 4, p);
      }
    }
  }
}

// A last one that rounding alone would make lies beyond the side.
int texels(int side_px, double shrink) { return static_cast<int>(std::ceil(side_px / shrink - 1e-9)); }

using Flags = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The 3×3 neighbourhood's maximum (`grow`) or minimum; beyond the border lies 0.
Flags spread(const Flags& flags, bool grow) {
  const Eigen::Index rows = flags.rows(), columns = flags.cols();
  Flags padded = Flags::Zero(rows + 2, columns + 2);
  padded.block(1, 1, rows, columns) = flags;
  const auto pick = [&](const auto& a, const auto& b, const auto& c) -> Flags {
    if (grow) return a.max(b).max(c);
    return a.min(b).min(c);
  };
  const Flags wide = pick(padded.leftCols(columns), padded.middleCols(1, columns), padded.rightCols(columns));
  return pick(wide.topRows(rows), wide.middleRows(1, rows), wide.bottomRows(rows));
}

}  // namespace

DrawingTexture drawingTexture(const Image& image, const Plane8& mask, const PixelBox& box, int max_size) {
  const double shrink = std::max(1.0, std::max(box.width(), box.height()) / double(max_size - 2 * kMargin));
  const int width = texels(box.width(), shrink), height = texels(box.height(), shrink);

  Flags figure = Flags::Zero(height + 2 * kMargin, width + 2 * kMargin);
  DrawingTexture result;
  result.image = Image(width + 2 * kMargin, height + 2 * kMargin);
  result.image.rgba.setZero();
  // A texel is the mean of the figure's pixels under it.
  const auto pixelsUnder = [&](int texel, int begin, int end) {
    const int first = begin + static_cast<int>(texel * shrink);
    const int after = std::min(end, begin + static_cast<int>((texel + 1) * shrink));
    return std::pair(first, std::max(first + 1, after));
  };
  std::vector<std::pair<int, int>> columns;
  for (int x = 0; x < width; ++x) columns.push_back(pixelsUnder(x, box.x0, box.x1));
  for (int y = 0; y < height; ++y) {
    const auto [top, bottom] = pixelsUnder(y, box.y0, box.y1);
    for (int x = 0; x < width; ++x) {
      const auto [left, right] = columns[x];
      std::uint8_t* texel = result.image.pixel(x + kMargin, y + kMargin);
      if (right - left == 1 && bottom - top == 1) {
        const std::uint8_t* p = image.pixel(left, top);
        if (mask(top, left) == 0) continue;
        figure(y + kMargin, x + kMargin) = 1;
        if (p[3] != 0) std::copy_n(p, 4, texel);
        continue;
      }
      std::int64_t sum[4] = {0, 0, 0, 0}, count = 0;
      for (int v = top; v < bottom; ++v) {
        for (int u = left; u < right; ++u) {
          if (mask(v, u) == 0) continue;
          const std::uint8_t* p = image.pixel(u, v);
          ++count, sum[3] += p[3];
          for (int c = 0; c < 3; ++c) sum[c] += p[c] * p[3];  // what is transparent has no colour
        }
      }
      if (count == 0) continue;
      figure(y + kMargin, x + kMargin) = 1;
      if (sum[3] == 0) continue;
      for (int c = 0; c < 3; ++c) texel[c] = static_cast<std::uint8_t>((sum[c] + sum[3] / 2) / sum[3]);
      texel[3] = static_cast<std::uint8_t>(sum[3] / count);
    }
  }

  // Beside the outline, paper shines through: those texels get the colours within. Thin parts keep their own.
  const int depth = std::clamp(static_cast<int>(std::lround(std::max(width, height) / 400.0)), 1, 3);
  Flags core = figure;
  for (int step = 0; step < depth; ++step) core = spread(core, false);
  Flags near_core = core;
  for (int step = 0; step < depth + 1; ++step) near_core = spread(near_core, true);
  const bool any_opaque = (result.image.rgba.col(3) >= 128).any();
  const int opaque = any_opaque ? 128 : 1;  // a ghost is faint all over
  bool any = false;
  for (int y = 0; y < result.image.height; ++y) {
    for (int x = 0; x < result.image.width; ++x) {
      std::uint8_t* p = result.image.pixel(x, y);
      const bool own = figure(y, x) && (core(y, x) || !near_core(y, x)) && p[3] >= opaque;
      p[3] = own ? 255 : 0;
      any = any || own;
    }
  }
  if (any) {
    pullPush(result.image);
  } else {
    result.image.rgba.setConstant(255);
  }
  result.figure = std::move(figure);
  const Eigen::Vector2d figure_corner(box.x0 - 0.5, box.y0 - 0.5);
  result.corner_px = figure_corner - Eigen::Vector2d::Constant(kMargin * shrink);
  result.size_px = shrink * Eigen::Vector2d(result.image.width, result.image.height);
  return result;
}

}  // namespace skel
