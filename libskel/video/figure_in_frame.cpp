#include "libskel/video/figure_in_frame.h"

#include <algorithm>
#include <cstdlib>

#include "libskel/core/check.h"
#include "libskel/video/low_pass.h"

namespace skel {
namespace {

Plane8 atLeast(const FloatPlane& plane, float level) {
  return (plane >= level).select(Plane8::Constant(plane.rows(), plane.cols(), 255), std::uint8_t{0});
}

}  // namespace

Image stillBackground(const std::vector<Image>& frames) {
  SKEL_CHECK(!frames.empty());
  Image background = frames[0];
  std::vector<std::uint8_t> values(frames.size());
  for (Eigen::Index i = 0; i < background.rgba.rows(); ++i)
    for (Eigen::Index c = 0; c < 3; ++c) {
      for (std::size_t f = 0; f < frames.size(); ++f) values[f] = frames[f].rgba(i, c);
      const auto middle = values.begin() + Eigen::Index(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      background.rgba(i, c) = *middle;
    }
  return background;
}

Plane8 foreground(const Image& frame, const Image& background, const ForegroundOptions& options) {
  SKEL_CHECK_EQ(frame.width, background.width);
  SKEL_CHECK_EQ(frame.height, background.height);
  FloatPlane difference(frame.height, frame.width);
  const std::uint8_t *a = frame.rgba.data(), *b = background.rgba.data();
  for (Eigen::Index i = 0; i < difference.size(); ++i, a += 4, b += 4)
    difference.data()[i] =
        static_cast<float>(std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}));
  return atLeast(lowPass(difference, options.cutoff), static_cast<float>(255 * options.difference));
}

Plane8 opaquePart(const Image& frame, const ForegroundOptions& options) {
  FloatPlane alpha(frame.height, frame.width);
  for (Eigen::Index i = 0; i < alpha.size(); ++i) alpha.data()[i] = frame.rgba(i, 3);
  return atLeast(lowPass(alpha, options.cutoff), 127.5f);
}

bool hasTransparency(const Image& frame) {
  return (frame.rgba.col(3) < 128).count() * 1000 >= frame.rgba.rows();
}

}  // namespace skel
