#include "libskel/silhouette/ink_edge.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace skel {
namespace {

cv::Mat square(int radius) { return cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8U); }

}  // namespace

void trimToInk(const Image& image, int reach, cv::Mat& figure) {
  constexpr int kMargin = 1, kThick = 4;
  constexpr float kLeastContrast = 10, kDeviations = 4, kFullContrast = 50;
  const int around = 3 * reach;  // px that tell what is outside
  const cv::Rect box = cv::boundingRect(figure);
  const cv::Rect place =
      cv::Rect(box.x - around, box.y - around, box.width + 2 * around, box.height + 2 * around) &
      cv::Rect(0, 0, figure.cols, figure.rows);
  const cv::Mat rgba =
      cv::Mat(image.height, image.width, CV_8UC4, const_cast<std::uint8_t*>(image.rgba.data()))(place);
  cv::Mat inside = figure(place);

  // What is outside, on the mean around each px, and how far each px is from that.
  cv::Mat weight, outside = ~inside;
  outside.convertTo(weight, CV_32F, 1 / 255.);
  const cv::Size window(2 * around + 1, 2 * around + 1);
  cv::Mat total, apart = cv::Mat::zeros(inside.size(), CV_32F);
  cv::boxFilter(weight, total, CV_32F, window, {-1, -1}, false);
  total = cv::max(total, 1);
  for (int c = 0; c < 3; ++c) {
    cv::Mat channel, mean;
    cv::extractChannel(rgba, channel, c);
    channel.convertTo(channel, CV_32F);
    cv::boxFilter(channel.mul(weight), mean, CV_32F, window, {-1, -1}, false);
    apart = cv::max(apart, cv::abs(channel - mean / total));
  }
  cv::Mat noise;
  cv::boxFilter(apart.mul(weight), noise, CV_32F, window, {-1, -1}, false);
  noise /= total;

  // Ink lies within reach, but for the width of a line.
  cv::Mat ink;
  cv::dilate(apart, ink, square(2 * reach));
  const cv::Mat least = cv::max(kDeviations * noise, kLeastContrast);
  cv::Mat thick;
  cv::morphologyEx(inside, thick, cv::MORPH_OPEN, square(kThick * reach));
  cv::dilate(thick, thick, square(2 * reach));
  const cv::Mat paper = (apart < cv::min(ink, kFullContrast) / 2) & (ink > least) & thick;
  cv::Mat trimmed = inside.clone();
  for (int layer = 0; layer < reach; ++layer) {
    cv::Mat core;
    cv::erode(trimmed, core, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, 1,
              cv::BORDER_CONSTANT, cv::Scalar(255));
    trimmed &= core | ~paper;
  }
  cv::dilate(trimmed, trimmed, cv::Mat::ones(3, 3, CV_8U), {-1, -1}, kMargin);
  inside &= trimmed;
}

}  // namespace skel
