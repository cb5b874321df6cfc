#include "libskel/silhouette/strokes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/levels.h"

namespace skel {

cv::Mat strokeContrast(const cv::Mat& rgb, bool dark_background, bool smooth) {
  cv::Mat value(rgb.size(), CV_8U);
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(y);
    std::uint8_t* out = value.ptr(y);
    for (int x = 0; x < rgb.cols; ++x) {
      out[x] = dark_background ? std::max({row[x][0], row[x][1], row[x][2]})
                               : std::min({row[x][0], row[x][1], row[x][2]});
    }
  }
  if (smooth) cv::GaussianBlur(value, value, cv::Size(3, 3), 0);
  const int size = std::max(3, std::max(rgb.cols, rgb.rows) / 24 * 2 + 1);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(size, size));
  cv::Mat contrast;
  cv::morphologyEx(value, contrast, dark_background ? cv::MORPH_TOPHAT : cv::MORPH_BLACKHAT, kernel);
  return contrast;
}

Noise noiseOf(const cv::Mat& values, const cv::Mat& excluded) {
  std::vector<float> sample;
  for (int y = 0; y < values.rows; y += 2) {
    const std::uint8_t *value = values.ptr(y), *is_excluded = excluded.ptr(y);
    for (int x = 0; x < values.cols; x += 2) {
      if (!is_excluded[x]) sample.push_back(value[x]);
    }
  }
  if (sample.empty()) return {};
  Noise noise;
  noise.level = median(sample);
  for (float& v : sample) v = static_cast<float>(std::abs(v - noise.level));
  noise.deviation = 1.48 * median(sample);
  return noise;
}

cv::Mat hysteresis(const cv::Mat& values, double low, double high) {
  cv::Mat weak = values > low, labels;
  const int count = cv::connectedComponents(weak, labels, 8, CV_32S);
  std::vector<std::uint8_t> strong(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < values.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    const std::uint8_t* value = values.ptr(y);
    for (int x = 0; x < values.cols; ++x) {
      if (label[x] > 0 && value[x] > high) strong[static_cast<std::size_t>(label[x])] = 255;
    }
  }
  for (int y = 0; y < values.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* out = weak.ptr(y);
    for (int x = 0; x < values.cols; ++x) out[x] = strong[static_cast<std::size_t>(label[x])];
  }
  return weak;
}

}  // namespace skel
