#include "libskel/silhouette/ink_edge.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

cv::Mat square(int radius) { return cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8U); }

void trim(const cv::Mat& picture, int reach, cv::Mat& figure) {
  constexpr int kMargin = 1, kThick = 4;
  constexpr double kLeastContrast = 10, kDeviations = 4, kFullContrast = 50;
  constexpr int kCoarse = 4;     // px of the picture in one of what changes slowly
  const int around = 3 * reach;  // px that tell what is outside
  const cv::Rect box = cv::boundingRect(figure);
  const cv::Rect place =
      cv::Rect(box.x - around, box.y - around, box.width + 2 * around, box.height + 2 * around) &
      cv::Rect(0, 0, figure.cols, figure.rows);
  const cv::Mat rgba = picture(place);
  cv::Mat inside = figure(place);

  // What is outside, on the mean around each px, and how far each px is from that.
  const cv::Mat outside = ~inside;
  const cv::Size coarse((place.width + kCoarse - 1) / kCoarse, (place.height + kCoarse - 1) / kCoarse);
  const int radius = std::max(1, around / kCoarse);
  const auto sums = [&](const cv::Mat& values) {  // of what is outside
    cv::Mat masked = cv::Mat::zeros(values.size(), values.type()), small;
    values.copyTo(masked, outside);
    cv::resize(masked, small, coarse, 0, 0, cv::INTER_AREA);
    cv::boxFilter(small, small, CV_32F, cv::Size(2 * radius + 1, 2 * radius + 1), {-1, -1}, false);
    return small;
  };
  const cv::Mat weight = cv::max(sums(outside) / 255, 1e-3);
  const auto meanOutside = [&](const cv::Mat& values, double factor) {
    cv::Mat mean = sums(values), divisors, full;
    cv::merge(std::vector<cv::Mat>(static_cast<std::size_t>(values.channels()), weight), divisors);
    cv::divide(mean, divisors, mean, factor, CV_32F);
    mean.convertTo(mean, CV_8U);
    cv::resize(mean, full, place.size(), 0, 0, cv::INTER_LINEAR);
    return full;
  };
  cv::Mat channels[4], apart;
  cv::absdiff(rgba, meanOutside(rgba, 1), apart);
  cv::split(apart, channels);
  apart = cv::max(cv::max(channels[0], channels[1]), channels[2]);

  // Ink lies within reach, but for the width of a line.
  cv::Mat ink;
  cv::dilate(apart, ink, square(2 * reach));
  const cv::Mat least = cv::max(meanOutside(apart, kDeviations), kLeastContrast);
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
  cv::dilate(trimmed, trimmed, square(kMargin));
  inside &= trimmed;
}

}  // namespace

void trimToInk(const Image& image, int reach, cv::Mat& figure) {
  constexpr int kFinest = 4096;  // long side, px: the work is that of the pixels times the reach
  const cv::Mat picture = rgbaOf(image);
  const double scale = kFinest / static_cast<double>(std::max(picture.cols, picture.rows));
  if (scale >= 1) return trim(picture, reach, figure);
  const cv::Size size(std::max(1, cvRound(picture.cols * scale)), std::max(1, cvRound(picture.rows * scale)));
  cv::Mat small, small_figure, trimmed;
  cv::resize(picture, small, size, 0, 0, cv::INTER_AREA);
  cv::resize(figure, small_figure, size, 0, 0, cv::INTER_AREA);
  small_figure = small_figure >= 128;
  trim(small, std::max(1, cvCeil(reach * scale)), small_figure);
  cv::resize(small_figure, trimmed, figure.size(), 0, 0, cv::INTER_LINEAR);
  figure &= trimmed >= 128;
}

}  // namespace skel
