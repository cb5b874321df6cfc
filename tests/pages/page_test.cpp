#include "trainer/pages/page.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/page_net.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

double intersectionOverUnion(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / std::max(1, cv::countNonZero(a | b));
}

TEST_CASE("Pages fit the net, mostly show a figure, and the same seed gives the same page") {
  int with_figure = 0;
  constexpr int kPages = 40;
  for (int i = 0; i < kPages; ++i) {
    Rng rng(7, static_cast<std::uint64_t>(i)), again = rng;
    const Page page = generatePage(rng, {}), same = generatePage(again, {});
    CHECK(std::max(page.rgb.cols, page.rgb.rows) == kPageNetSize);
    CHECK(page.figure.size() == page.rgb.size());
    CHECK(cv::norm(page.rgb, same.rgb, cv::NORM_INF) == 0);
    CHECK(cv::norm(page.figure, same.figure, cv::NORM_INF) == 0);
    with_figure += cv::countNonZero(page.figure > 127) > 50;
  }
  CHECK(with_figure >= .85 * kPages);
}

TEST_CASE("Some pages are as programs give them, some figures are cut by the border, some have company") {
  constexpr int kPages = 150;
  int even = 0, cut = 0, pairs = 0;
  for (int i = 0; i < kPages; ++i) {
    Rng rng(8, static_cast<std::uint64_t>(i));
    const Page page = generatePage(rng, {});
    const cv::Mat figure = page.figure > 127;
    const int w = figure.cols, h = figure.rows;
    const cv::Vec3b corner = page.rgb.at<cv::Vec3b>(0, 0);
    even += corner == page.rgb.at<cv::Vec3b>(0, w - 1) && corner == page.rgb.at<cv::Vec3b>(h / 2, 0) &&
            corner == page.rgb.at<cv::Vec3b>(h / 2, w - 1);
    cut += cv::countNonZero(figure.row(0)) + cv::countNonZero(figure.row(h - 1)) +
               cv::countNonZero(figure.col(0)) + cv::countNonZero(figure.col(w - 1)) >
           5;
    cv::Mat labels, stats, centres;
    const int count = cv::connectedComponentsWithStats(figure, labels, stats, centres);
    int large = 0;
    for (int k = 1; k < count; ++k)
      large += stats.at<int>(k, cv::CC_STAT_AREA) > .1 * cv::countNonZero(figure) &&
               stats.at<int>(k, cv::CC_STAT_HEIGHT) > h / 4;
    pairs += large >= 2;
  }
  CHECK(even > .2 * kPages);
  CHECK(cut > .03 * kPages);
  CHECK(pairs > .03 * kPages);
}

TEST_CASE("The built-in net finds figures on pages that it has not seen") {
  double sum = 0;
  constexpr int kPages = 60;
  for (int i = 0; i < kPages; ++i) {
    Rng rng(2024, static_cast<std::uint64_t>(i));
    const Page page = generatePage(rng, {});
    if (cv::countNonZero(page.figure > 127) < 50) {
      sum += 1;
      continue;
    }
    sum += intersectionOverUnion(figureProbability(builtInPageNet(), page.rgb) > .5f, page.figure > 127);
  }
  CHECK(sum / kPages > .6);
}

}  // namespace
}  // namespace skel
