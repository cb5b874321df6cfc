#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"

namespace skel {

namespace {

// How much each source pixel from `first` on gives to one target pixel, along one axis.
struct Taps {
  int first;
  std::vector<float> weights;  // sum 1
};

// Of `count` target pixels from `begin` on, where `from` source pixels become `to`.
std::vector<Taps> tapsFor(int from, int to, int begin, int count) {
  std::vector<Taps> taps;
  const double scale = double(from) / to;
  for (int i = begin; i < begin + count; ++i) {
    const double center = (i + 0.5) * scale - 0.5;
    // Shrinking: the source pixels that the target pixel covers. Growing: the two nearest.
    const double half = scale > 1 ? scale / 2 : 1;
    const int first = std::max(0, int(std::ceil(center - half - 0.5)));
    const int last = std::min(from - 1, int(std::floor(center + half + 0.5)));
    Taps tap{first, {}};
    float sum = 0;
    for (int k = first; k <= last; ++k) {
      const double covered = std::min(k + 0.5, center + half) - std::max(k - 0.5, center - half);
      const double near = 1 - std::abs(k - center);
      tap.weights.push_back(float(std::max(0.0, scale > 1 ? covered : near)));
      sum += tap.weights.back();
    }
    for (float& weight : tap.weights) weight /= sum;
    taps.push_back(std::move(tap));
  }
  return taps;
}

// The part of `width` x `height` px at (left, top) of the image resized to `whole_width` x `whole_height`,
// which may be far more than there is memory for.
Image resizedPart(const Image& image, int whole_width, int whole_height, int left, int top, int width,
                  int height) {
  const std::vector<Taps> across = tapsFor(image.width, whole_width, left, width),
                          down = tapsFor(image.height, whole_height, top, height);
  // Colours weighted by alpha, so that clear pixels do not bleed. Source rows made narrow, as many as a
  // target row needs: the next one takes the place of the oldest.
  std::size_t most = 0;
  for (const Taps& taps : down) most = std::max(most, taps.weights.size());
  std::vector<Eigen::Array4f> narrow(most * std::size_t(width));
  const auto narrowRow = [&](int y) { return narrow.data() + (std::size_t(y) % most) * std::size_t(width); };
  int next = down.front().first;
  Image result(width, height);
  for (int y = 0; y < height; ++y) {
    for (; next < down[y].first + int(down[y].weights.size()); ++next)
      for (int x = 0; x < width; ++x) {
        Eigen::Array4f sum = Eigen::Array4f::Zero();
        for (std::size_t k = 0; k < across[x].weights.size(); ++k) {
          const std::uint8_t* p = image.pixel(across[x].first + int(k), next);
          const float alpha = p[3] * across[x].weights[k];
          sum += Eigen::Array4f(p[0] * alpha, p[1] * alpha, p[2] * alpha, alpha);
        }
        narrowRow(next)[x] = sum;
      }
    for (int x = 0; x < width; ++x) {
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      for (std::size_t k = 0; k < down[y].weights.size(); ++k)
        sum += down[y].weights[k] * narrowRow(down[y].first + int(k))[x];
      std::uint8_t* p = result.pixel(x, y);
      for (int c = 0; c < 3; ++c)
        p[c] = sum[3] > 0 ? std::uint8_t(std::min(255l, std::lround(sum[c] / sum[3]))) : 0;
      p[3] = std::uint8_t(std::min(255l, std::lround(sum[3])));
    }
  }
  return result;
}

}  // namespace

Image resized(const Image& image, int width, int height) {
  SKEL_CHECK(!image.empty() && width >= 1 && height >= 1);
  if (width == image.width && height == image.height) return image;
  return resizedPart(image, width, height, 0, 0, width, height);
}

Image fitted(const Image& image, int max_width, int max_height) {
  const double scale = std::min(double(max_width) / image.width, double(max_height) / image.height);
  return resized(image, std::clamp(int(std::lround(image.width * scale)), 1, max_width),
                 std::clamp(int(std::lround(image.height * scale)), 1, max_height));
}

Image covering(const Image& picture, int width, int height) {
  const double scale = std::max(double(width) / picture.width, double(height) / picture.height);
  const int whole_width = std::max(width, int(std::lround(picture.width * scale))),
            whole_height = std::max(height, int(std::lround(picture.height * scale)));
  const int left = (whole_width - width) / 2, top = (whole_height - height) / 2;
  if (whole_width != picture.width || whole_height != picture.height)
    return resizedPart(picture, whole_width, whole_height, left, top, width, height);
  Image result = blankImage(width, height, kClear);
  blit(result, picture, -left, -top);
  return result;
}

Image magnified(const Image& image, int factor) {
  SKEL_CHECK(factor >= 1);
  Image result(image.width * factor, image.height * factor);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.pixel(x / factor, y / factor), 4, result.pixel(x, y));
  return result;
}

}  // namespace skel
