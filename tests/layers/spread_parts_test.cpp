// Probabilities that go as far as the drawing's flat areas.
#include "libskel/layers/spread_parts.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/catch.h"

using namespace skel;

namespace {

// White, 120 px square, with a black line of 3 px down the middle; all is figure but the rim.
struct Sheet {
  cv::Mat rgb = cv::Mat(120, 120, CV_8UC3, cv::Scalar::all(255)), mask = cv::Mat::zeros(120, 120, CV_8U);
  std::vector<cv::Mat> parts;  // left and right of the border that was said

  // Says that it lies at x = `border`.
  explicit Sheet(int border) {
    mask(cv::Rect(4, 4, 112, 112)) = 255;
    rgb.colRange(59, 62) = cv::Scalar::all(0);
    cv::Mat left = cv::Mat::zeros(120, 120, CV_32F);
    left.colRange(0, border) = 1;
    cv::GaussianBlur(left, left, cv::Size(0, 0), 4);
    parts = {left, 1 - left, cv::Mat()};
  }
};

}  // namespace

TEST_CASE("a border of parts that was said beside a line comes to lie on the line") {
  Sheet sheet(66);
  REQUIRE(sheet.parts[0].at<float>(60, 64) > .6f);
  spreadParts(sheet.rgb, sheet.mask, 255, sheet.parts);
  for (const int y : {10, 60, 110}) {
    CHECK(sheet.parts[0].at<float>(y, 57) > .9f);
    CHECK(sheet.parts[0].at<float>(y, 64) < .5f);
  }
}

TEST_CASE("where nothing is drawn, a border of parts stays where it was said") {
  Sheet sheet(75);
  sheet.rgb = cv::Scalar::all(255);
  spreadParts(sheet.rgb, sheet.mask, 255, sheet.parts);
  CHECK(sheet.parts[0].at<float>(60, 70) > .5f);
  CHECK(sheet.parts[0].at<float>(60, 80) < .5f);
}

TEST_CASE("spread probabilities share each px of the figure, and nothing outside of it") {
  Sheet sheet(66);
  spreadParts(sheet.rgb, sheet.mask, 255, sheet.parts);
  CHECK(sheet.parts[2].empty());
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const float sum = sheet.parts[0].at<float>(y, x) + sheet.parts[1].at<float>(y, x);
      REQUIRE(sum == Approx(sheet.mask.at<std::uint8_t>(y, x) != 0 ? 1 : 0).margin(1e-4));
    }
}

TEST_CASE("a figure of no px has no parts to spread") {
  Sheet sheet(60);
  sheet.mask = cv::Scalar(0);
  spreadParts(sheet.rgb, sheet.mask, 255, sheet.parts);
  CHECK(cv::countNonZero(sheet.parts[0]) == 0);
}

TEST_CASE("a figure above 200 px is spread at that size, and more parts than go together do not differ") {
  Sheet sheet(66);
  cv::resize(sheet.rgb, sheet.rgb, {}, 3, 3, cv::INTER_NEAREST);
  cv::resize(sheet.mask, sheet.mask, {}, 3, 3, cv::INTER_NEAREST);
  cv::Mat left, right;
  cv::resize(sheet.parts[0], left, {}, 3, 3, cv::INTER_LINEAR);
  right = 1 - left;
  std::vector<cv::Mat> alone = {left.clone()}, many;
  for (int k = 0; k < 9; ++k) many.push_back((k == 8 ? left : right).clone());
  spreadParts(sheet.rgb, sheet.mask, 255, alone);
  spreadParts(sheet.rgb, sheet.mask, 255, many);
  REQUIRE(alone[0].size() == cv::Size(200, 200));
  for (const cv::Mat& plane : many) REQUIRE(plane.size() == cv::Size(200, 200));
  CHECK(cv::norm(alone[0], many[8], cv::NORM_INF) == 0);
  CHECK(cv::norm(many[0], many[7], cv::NORM_INF) == 0);
  CHECK(alone[0].at<float>(100, 95) > .9f);
  CHECK(alone[0].at<float>(100, 107) < .5f);
  CHECK(alone[0].at<float>(100, 107) + many[0].at<float>(100, 107) == Approx(1).margin(1e-4));
}

TEST_CASE("probabilities that are coarser than the picture are spread as those of its own size are") {
  Sheet sheet(66);
  for (std::size_t k = 0; k < 2; ++k) cv::resize(sheet.parts[k], sheet.parts[k], {}, .5, .5, cv::INTER_AREA);
  spreadParts(sheet.rgb, sheet.mask, 255, sheet.parts);
  REQUIRE(sheet.parts[0].size() == sheet.mask.size());
  CHECK(sheet.parts[0].at<float>(60, 57) > .9f);
  CHECK(sheet.parts[0].at<float>(60, 64) < .5f);
  CHECK(sheet.parts[0].at<float>(1, 1) == 0);
}
