// Colours: k-means in OKLab (S. Lloyd, "Least squares quantization in PCM", 1982), which starts from the
// boxes of palette.h. Pixels: the medoid of a square of colours, which keeps edges where averages smear them.
#include "animator/pixel_look.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/draw/oklab.h"
#include "libskel/video/palette.h"

namespace skel {
namespace {

// A colour that is seen, and how much it weighs.
struct Seen {
  Eigen::Vector3f lab;
  float weight;
  int nearest = 0;  // of the palette
};

int keyOf(const std::uint8_t* p) { return p[0] << 16 | p[1] << 8 | p[2]; }
Color colorOf(int key) { return {std::uint8_t(key >> 16), std::uint8_t(key >> 8), std::uint8_t(key)}; }

int nearestOf(const std::vector<Eigen::Vector3f>& palette, const Eigen::Vector3f& lab) {
  const auto nearer = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return (a - lab).squaredNorm() < (b - lab).squaredNorm();
  };
  return int(std::min_element(palette.begin(), palette.end(), nearer) - palette.begin());
}

// Small things of a colour of their own, such as eyes, count for more than their size.
std::map<int, Seen> seenIn(const std::vector<Image>& pictures) {
  std::map<int, int> count;
  for (const Image& picture : pictures)
    for (Eigen::Index i = 0; i < picture.rgba.rows(); ++i)
      if (const std::uint8_t* p = picture.rgba.data() + 4 * i; p[3] > 0) ++count[keyOf(p)];
  std::map<int, Seen> seen;
  for (const auto& [key, n] : count) seen[key] = {oklabFromSrgb(colorOf(key)), std::sqrt(float(n))};
  return seen;
}

void paint(std::vector<Image>& pictures, const std::map<int, Seen>& seen, const std::vector<Color>& palette) {
  for (Image& picture : pictures)
    for (Eigen::Index i = 0; i < picture.rgba.rows(); ++i) {
      std::uint8_t* p = picture.rgba.data() + 4 * i;
      if (p[3] == 0) continue;
      const Color color = palette[std::size_t(seen.at(keyOf(p)).nearest)];
      p[0] = color.r, p[1] = color.g, p[2] = color.b;
    }
}

}  // namespace

Image pixelated(const Image& large, int factor) {
  SKEL_CHECK(large.width % factor == 0 && large.height % factor == 0);
  Image small(large.width / factor, large.height / factor);
  std::vector<const std::uint8_t*> covered;
  std::vector<Eigen::Vector3f> colors;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      covered.clear();
      colors.clear();
      for (int v = 0; v < factor; ++v)
        for (int u = 0; u < factor; ++u)
          if (const std::uint8_t* p = large.pixel(x * factor + u, y * factor + v); p[3] >= 128) {
            covered.push_back(p);
            colors.push_back(oklabFromSrgb({p[0], p[1], p[2]}));
          }
      std::uint8_t* pixel = small.pixel(x, y);
      std::fill_n(pixel, 4, std::uint8_t(0));
      if (2 * int(covered.size()) < factor * factor) continue;
      std::size_t medoid = 0;
      float least = INFINITY;
      for (std::size_t i = 0; i < colors.size(); ++i) {
        float sum = 0;
        for (const Eigen::Vector3f& other : colors) sum += (colors[i] - other).norm();
        if (sum < least) least = sum, medoid = i;
      }
      std::copy_n(covered[medoid], 3, pixel);
      pixel[3] = 255;
    }
  return small;
}

std::vector<Color> paletteOf(const Image& picture, const std::string& path) {
  constexpr std::size_t kMost = 256;
  const std::map<int, Seen> seen = seenIn({picture});
  if (seen.empty()) throw InputError(path, "is all clear: a palette is a picture that has its colours");
  if (seen.size() > kMost)
    throw InputError(path, "has " + std::to_string(seen.size()) + " colours, a palette at most " +
                               std::to_string(kMost) + "; take a picture that has its colours alone");
  std::vector<Color> palette;
  for (const auto& [key, one] : seen) palette.push_back(colorOf(key));
  return palette;
}

void takeColors(std::vector<Image>& pictures, const std::vector<Color>& palette) {
  std::map<int, Seen> seen = seenIn(pictures);
  std::vector<Eigen::Vector3f> labs;
  for (const Color& color : palette) labs.push_back(oklabFromSrgb(color));
  for (auto& [key, one] : seen) one.nearest = nearestOf(labs, one.lab);
  paint(pictures, seen, palette);
}

void reduceColors(std::vector<Image>& pictures, int colors) {
  constexpr int kRounds = 24;
  std::map<int, Seen> seen = seenIn(pictures);
  if (int(seen.size()) <= colors) return;
  std::vector<Rgb> distinct;
  for (const auto& [key, one] : seen) {
    const Color color = colorOf(key);
    distinct.push_back({color.r, color.g, color.b});
  }
  std::vector<Eigen::Vector3f> palette;
  for (const Rgb& c : choosePalette(distinct, colors).colors)
    palette.push_back(oklabFromSrgb({c[0], c[1], c[2]}));
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector4f> sums(palette.size(), Eigen::Vector4f::Zero());
    for (auto& [key, one] : seen) {
      one.nearest = nearestOf(palette, one.lab);
      sums[std::size_t(one.nearest)] += one.weight * one.lab.homogeneous();
    }
    for (std::size_t i = 0; i < palette.size(); ++i)
      if (sums[i][3] > 0) palette[i] = sums[i].head<3>() / sums[i][3];
  }
  std::vector<Color> srgb;
  for (const Eigen::Vector3f& lab : palette) srgb.push_back(srgbFromOklab(lab));
  paint(pictures, seen, srgb);
}

void addOutline(Image& picture, Color color) {
  const Image before = picture;
  const auto opaque = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < before.width && y < before.height && before.pixel(x, y)[3] > 0;
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      if (opaque(x, y)) continue;
      if (!opaque(x - 1, y) && !opaque(x + 1, y) && !opaque(x, y - 1) && !opaque(x, y + 1)) continue;
      std::uint8_t* p = picture.pixel(x, y);
      p[0] = color.r, p[1] = color.g, p[2] = color.b, p[3] = 255;
    }
}

Color darkestColor(const std::vector<Image>& pictures) {
  Color darkest = kInk;
  float least = INFINITY;
  for (const auto& [key, one] : seenIn(pictures))
    if (one.lab[0] < least) least = one.lab[0], darkest = colorOf(key);
  return darkest;
}

}  // namespace skel
