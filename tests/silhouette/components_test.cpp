#include "libskel/silhouette/components.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("components have the areas, boxes and centres that OpenCV's statistics tell") {
  cv::Mat mask(90, 130, CV_8U);
  cv::RNG random(7);
  random.fill(mask, cv::RNG::UNIFORM, 0, 256);
  cv::blur(mask, mask, {5, 5});
  mask = mask > 132;
  for (const int connectivity : {4, 8}) {
    cv::Mat labels, expected_labels, stats, centres;
    const int count = cv::connectedComponentsWithStats(mask, expected_labels, stats, centres, connectivity);
    const std::vector<Component> found = componentsOf(mask, connectivity, labels);
    REQUIRE(found.size() == static_cast<std::size_t>(count));
    REQUIRE(count > 10);
    CHECK(cv::countNonZero(labels != expected_labels) == 0);
    int most = 0;
    for (int i = 1; i < count; ++i) {
      CAPTURE(connectivity, i);
      const Component& c = found[static_cast<std::size_t>(i)];
      CHECK(c.area == stats.at<int>(i, cv::CC_STAT_AREA));
      CHECK(c.x == stats.at<int>(i, cv::CC_STAT_LEFT));
      CHECK(c.y == stats.at<int>(i, cv::CC_STAT_TOP));
      CHECK(c.width == stats.at<int>(i, cv::CC_STAT_WIDTH));
      CHECK(c.height == stats.at<int>(i, cv::CC_STAT_HEIGHT));
      CHECK(c.centre_x == centres.at<double>(i, 0));
      CHECK(c.centre_y == centres.at<double>(i, 1));
      most = std::max(most, c.area);
    }
    CHECK(found[static_cast<std::size_t>(largestOf(found))].area == most);
  }
}

TEST_CASE("a mask without pixels has no largest component") {
  cv::Mat labels;
  CHECK(largestOf(componentsOf(cv::Mat::zeros(4, 5, CV_8U), 8, labels)) == 0);
}
