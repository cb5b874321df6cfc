#include "libskel/silhouette/working_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/levels.h"

namespace skel {

cv::Mat rgbaOf(const Image& image) {
  return {image.height, image.width, CV_8UC4, const_cast<std::uint8_t*>(image.rgba.data())};
}

cv::Mat viewOf(const Plane8& plane) {
  return {static_cast<int>(plane.rows()), static_cast<int>(plane.cols()), CV_8U,
          const_cast<std::uint8_t*>(plane.data())};
}

Image imageOfRgb(const cv::Mat& rgb) {
  Image image(rgb.cols, rgb.rows);
  cv::Mat rgba(rgb.rows, rgb.cols, CV_8UC4, image.rgba.data());
  cv::mixChannels(rgb, rgba, {0, 0, 1, 1, 2, 2});
  image.rgba.col(3).setConstant(255);
  return image;
}

cv::Mat workingRgb(const Image& image) {
  const cv::Mat rgba = rgbaOf(image);
  const double scale = std::min(1.0, kWorkingSize / static_cast<double>(std::max(image.width, image.height)));
  cv::Mat small;
  if (scale < 1) {
    const cv::Size size(std::max(1, cvRound(image.width * scale)),
                        std::max(1, cvRound(image.height * scale)));
    // Averaging over areas is many times slower and differs little at such a scale.
    cv::resize(rgba, small, size, 0, 0, scale > 0.5 ? cv::INTER_LINEAR : cv::INTER_AREA);
  } else {
    small = rgba;
  }
  cv::Mat rgb(small.size(), CV_8UC3);
  for (int y = 0; y < small.rows; ++y) {
    const cv::Vec4b* from = small.ptr<cv::Vec4b>(y);
    cv::Vec3b* to = rgb.ptr<cv::Vec3b>(y);
    for (int x = 0; x < small.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        to[x][c] = static_cast<std::uint8_t>(255 - (255 - from[x][c]) * from[x][3] / 255);
      }
    }
  }
  return rgb;
}

// OpenCV's own conversion first fills tables for 200 ms.
cv::Mat labOf(const cv::Mat& rgb) {
  constexpr int kSteps = 4096;
  struct Tables {
    std::array<float, 256> linear;
    std::array<float, kSteps + 1> root;  // Lab's f(t), which is steep near 0
    Tables() {
      for (int i = 0; i < 256; ++i) {
        const double v = i / 255.0;
        linear[static_cast<std::size_t>(i)] =
            static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
      }
      for (int i = 0; i <= kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps;
        root[static_cast<std::size_t>(i)] =
            static_cast<float>(t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29);
      }
    }
  };
  static const Tables tables;
  const auto f = [](float t) {
    return tables.root[static_cast<std::size_t>(std::min(t, 1.0f) * kSteps + 0.5f)];
  };
  cv::Mat lab(rgb.size(), CV_8UC3);
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* from = rgb.ptr<cv::Vec3b>(y);
    cv::Vec3b* to = lab.ptr<cv::Vec3b>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      const float r = tables.linear[from[x][0]], g = tables.linear[from[x][1]], b = tables.linear[from[x][2]];
      const float fx = f(0.433953f * r + 0.376219f * g + 0.189828f * b);
      const float fy = f(0.212671f * r + 0.715160f * g + 0.072169f * b);
      const float fz = f(0.017758f * r + 0.109477f * g + 0.872765f * b);
      to[x] = {toByte(2.55f * (116 * fy - 16)), toByte(500 * (fx - fy) + 128), toByte(200 * (fy - fz) + 128)};
    }
  }
  return lab;
}

}  // namespace skel
