#include "libskel/silhouette/ink_edge.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/catch.h"

namespace skel {
namespace {

constexpr int kSize = 200;
const cv::Point kCentre(100, 100);

Image imageOf(const cv::Mat& rgb) {
  Image image(rgb.cols, rgb.rows);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3b c = rgb.at<cv::Vec3b>(y, x);
      std::uint8_t* p = image.pixel(x, y);
      for (int k = 0; k < 3; ++k) p[k] = c[k];
      p[3] = 255;
    }
  return image;
}

// White paper whose grey level sways a little from px to px.
cv::Mat paper() {
  cv::Mat page(kSize, kSize, CV_8UC3);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      page.at<cv::Vec3b>(y, x) = cv::Vec3b::all(static_cast<std::uint8_t>(236 + (7 * x + 13 * y) % 5));
  return page;
}

cv::Mat disc(int radius) {
  cv::Mat mask = cv::Mat::zeros(kSize, kSize, CV_8U);
  cv::circle(mask, kCentre, radius, 255, cv::FILLED);
  return mask;
}

TEST_CASE("a figure that reaches beyond its outline is trimmed to it") {
  for (const int grey : {20, 120, 190}) {
    cv::Mat page = paper();
    cv::circle(page, kCentre, 58, cv::Scalar::all(grey), 5);  // a ring of ink to radius 60, paper inside
    cv::Mat figure = disc(64);
    trimToInk(imageOf(page), 5, figure);
    CAPTURE(grey);
    CHECK(cv::countNonZero(figure & ~disc(63)) == 0);
    CHECK(cv::countNonZero(disc(60) & ~figure) == 0);
  }
}

TEST_CASE("without ink nothing is trimmed") {
  cv::Mat figure = disc(60);
  trimToInk(imageOf(paper()), 5, figure);
  CHECK(cv::countNonZero(figure != disc(60)) == 0);
}

TEST_CASE("a stroke keeps its thickness") {
  cv::Mat page = paper(), figure = cv::Mat::zeros(kSize, kSize, CV_8U);
  cv::line(page, {20, 100}, {180, 100}, cv::Scalar::all(30), 3);
  cv::line(figure, {20, 100}, {180, 100}, 255, 11);
  const cv::Mat before = figure.clone();
  trimToInk(imageOf(page), 5, figure);
  CHECK(cv::countNonZero(figure != before) == 0);
}

}  // namespace
}  // namespace skel
