#include "libskel/silhouette/page_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/check.h"
#include "libskel/silhouette/components.h"

namespace skel {
namespace {

constexpr std::array kWidths = {16, 48, 64, 96, 128};
constexpr std::array kDown = {1, 2, 2, 1};
constexpr std::array kUp = {1, 2, 1, 1};

// What the net says of a picture of any size.
cv::Mat probabilityAt(const PageNet& net, const cv::Mat& rgb) {
  const double scale = static_cast<double>(kPageNetSize) / std::max(rgb.cols, rgb.rows);
  const cv::Size size(std::clamp(cvRound(rgb.cols * scale), 1, kPageNetSize),
                      std::clamp(cvRound(rgb.rows * scale), 1, kPageNetSize));
  cv::Mat small;
  cv::resize(rgb, small, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  ConvNetMaps maps(net);
  encodePage(small, maps.maps[0]);
  forward(net, bestInstructionSet(), maps);
  cv::Mat probability(size, CV_32F), out;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      probability.at<float>(y, x) = 1 / (1 + std::exp(-maps.maps.back()[pageLogitIndex(y, x)]));
  cv::resize(probability, out, rgb.size(), 0, 0, cv::INTER_LINEAR);
  return out;
}

}  // namespace

PageNet makePageNet() {
  ConvNetBuilder b({kPageMapSize, kPageMapSize, kPageInputChannels});
  const int first = b.convolution(0, kWidths[0], 3, true);
  b.convolution(hourglass(b, first, kWidths, kDown, kUp), kPageOutputChannels, 1, false);
  PageNet net;
  static_cast<ConvNet&>(net) = b.take();
  return net;
}

void encodePage(const cv::Mat& rgb, std::vector<float>& input) {
  SKEL_CHECK(rgb.cols <= kPageNetSize && rgb.rows <= kPageNetSize && rgb.type() == CV_8UC3);
  input.assign(MapShape{kPageMapSize, kPageMapSize, kPageInputChannels}.paddedSize(), 0.f);
  const auto at = [&](int y, int x) {
    return input.data() +
           static_cast<std::size_t>(paddedIndex(kPageMapSize, y / 2, x / 2)) * kPageInputChannels;
  };
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      float* o = at(y, x);
      for (int k = 0; k < 3; ++k)
        o[3 * (2 * (y % 2) + x % 2) + k] = (static_cast<float>(row[x][k]) - 160) / 64;
      o[12] += .25f;
    }
  }
  // Where on the page.
  for (int y = 0; y < kPageMapSize; ++y)
    for (int x = 0; x < kPageMapSize; ++x) {
      float* o = at(2 * y, 2 * x);
      if (o[12] == 0) continue;
      o[13] = 2 * (2 * static_cast<float>(x) + 1) / static_cast<float>(rgb.cols) - 1;
      o[14] = 2 * (2 * static_cast<float>(y) + 1) / static_cast<float>(rgb.rows) - 1;
    }
}

cv::Mat figureProbability(const PageNet& net, const cv::Mat& rgb) {
  cv::Mat probability = probabilityAt(net, rgb);
  cv::Mat labels;
  const std::vector<Component> parts = componentsOf(probability > .5f, 8, labels);
  const Component& box = parts[static_cast<std::size_t>(largestOf(parts))];
  if (box.area == 0) return probability;
  const int margin = cvRound(.25 * std::max(box.width, box.height));
  const cv::Rect window =
      cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
      cv::Rect(0, 0, rgb.cols, rgb.rows);
  constexpr double kMuchSmaller = .85;
  if (std::max(window.width, window.height) > kMuchSmaller * std::max(rgb.cols, rgb.rows)) return probability;
  probabilityAt(net, rgb(window)).copyTo(probability(window));
  return probability;
}

}  // namespace skel
