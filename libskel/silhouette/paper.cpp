#include "libskel/silhouette/paper.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace skel {

Plane8 paperForeground(const Image& image) {
  cv::Mat value(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      const int brightest = std::max({p[0], p[1], p[2]});
      value.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(255 - (255 - brightest) * p[3] / 255);
    }
  }
  cv::Mat paper;
  cv::threshold(value, paper, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  // A frame of background around the picture, so that one fill comes in from all sides.
  cv::Mat framed;
  cv::copyMakeBorder(paper, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  constexpr std::uint8_t kOutside = 128;
  cv::floodFill(framed, cv::Point(0, 0), cv::Scalar(kOutside));
  Plane8 foreground(image.height, image.width);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      foreground(y, x) = framed.at<std::uint8_t>(y + 1, x + 1) == kOutside ? 0 : 255;
    }
  }
  return foreground;
}

}  // namespace skel
