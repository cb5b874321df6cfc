// Pictures in memory. Everywhere in skel a point "in image px" has its origin at the centre of the top left
// pixel, +x to the right, +y down: the centre of column x, row y is (x, y).
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace skel {

// H×W, one byte a pixel. As a mask: 0 outside, 255 on the figure.
using Plane8 = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// sRGB with straight (not premultiplied) alpha, EXIF orientation applied.
struct Image {
  int width = 0, height = 0;
  Eigen::Array<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> rgba;  // (H·W)×4, row y·W + x

  Image() = default;
  Image(int width, int height) : width(width), height(height), rgba(std::int64_t{width} * height, 4) {}

  bool empty() const { return width == 0 || height == 0; }
  std::uint8_t* pixel(int x, int y) { return rgba.data() + 4 * (std::int64_t{y} * width + x); }
  const std::uint8_t* pixel(int x, int y) const { return rgba.data() + 4 * (std::int64_t{y} * width + x); }
};

}  // namespace skel
