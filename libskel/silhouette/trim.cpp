#include "libskel/silhouette/trim.h"

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/components.h"
#include "libskel/silhouette/simple_point.h"

namespace skel {

void dropOuterEdges(cv::Mat& figure, const cv::Mat& edges) {
  cv::Mat outside;
  cv::dilate(figure == 0, outside, cv::Mat::ones(3, 3, CV_8U));
  figure &= ~(edges & outside);
}

void trimSoftEdge(cv::Mat& figure, const cv::Mat& drawn, const cv::Mat& strength) {
  cv::Mat strongest;
  cv::dilate(strength, strongest, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat framed;
  cv::copyMakeBorder(figure, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  for (int y = 0; y < figure.rows; ++y) {
    const std::uint8_t *own = strength.ptr(y), *best = strongest.ptr(y), *is_drawn = drawn.ptr(y);
    const std::uint8_t *above = framed.ptr(y) + 1, *below = framed.ptr(y + 2) + 1;
    std::uint8_t* row = framed.ptr(y + 1) + 1;
    for (int x = 0; x < figure.cols; ++x) {
      if (!row[x] || !is_drawn[x] || 2 * own[x] >= best[x]) continue;
      const std::array<bool, 8> n = {above[x - 1] != 0, above[x] != 0, above[x + 1] != 0, row[x + 1] != 0,
                                     below[x + 1] != 0, below[x] != 0, below[x - 1] != 0, row[x - 1] != 0};
      if (isSimplePoint(n)) row[x] = 0;
    }
  }
  figure = framed(cv::Rect(1, 1, figure.cols, figure.rows)).clone();
}

bool touchesBorder(const cv::Mat& figure) {
  return cv::countNonZero(figure.row(0)) + cv::countNonZero(figure.row(figure.rows - 1)) +
             cv::countNonZero(figure.col(0)) + cv::countNonZero(figure.col(figure.cols - 1)) >
         0;
}

void dropBorderStrips(cv::Mat& figure) {
  const int w = figure.cols, h = figure.rows;
  if (!touchesBorder(figure)) return;
  cv::Mat labels;
  const std::vector<Component> parts = componentsOf(figure, 4, labels);
  std::vector<int> contact(parts.size(), 0);
  for (int x = 0; x < w; ++x) {
    ++contact[static_cast<std::size_t>(labels.at<int>(0, x))];
    ++contact[static_cast<std::size_t>(labels.at<int>(h - 1, x))];
  }
  for (int y = 0; y < h; ++y) {
    ++contact[static_cast<std::size_t>(labels.at<int>(y, 0))];
    ++contact[static_cast<std::size_t>(labels.at<int>(y, w - 1))];
  }
  constexpr double kStrip = 3;  // contact over the root of the area; about 2 for a half figure
  for (int y = 0; y < h; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* row = figure.ptr(y);
    for (int x = 0; x < w; ++x) {
      const auto part = static_cast<std::size_t>(label[x]);
      if (part > 0 && contact[part] > kStrip * std::sqrt(parts[part].area)) row[x] = 0;
    }
  }
}

}  // namespace skel
