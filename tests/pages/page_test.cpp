#include "trainer/pages/page.h"

#include <opencv2/core.hpp>

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
