#include "libskel/silhouette/settle.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/working_colors.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

// A red square on paper, what the net sees of it, and what lines and colours say.
struct Page {
  cv::Mat lab, probability = cv::Mat(100, 100, CV_32F, cv::Scalar(.05)),
               drawn = cv::Mat::zeros(100, 100, CV_8U);
  cv::Rect square{30, 30, 40, 40};

  Page() {
    cv::Mat rgb(100, 100, CV_8UC3, cv::Scalar(245, 243, 238));
    rgb(square).setTo(cv::Scalar(200, 40, 30));
    lab = labOf(rgb);
  }
  float at(int y, int x) const { return settled(drawn, probability, lab).at<float>(y, x); }
};

}  // namespace

TEST_CASE(
    "what the net is sure of in the middle of an even patch holds up to the patch's edge, and no farther") {
  Page page;
  cv::circle(page.probability, {50, 50}, 12, cv::Scalar(.98), cv::FILLED);
  cv::circle(page.probability, {30, 50}, 6, cv::Scalar(.4), cv::FILLED);  // blurred over the edge
  page.drawn(page.square).setTo(255);
  CHECK(page.at(50, 31) > .5f);
  CHECK(page.at(50, 28) < .5f);
  CHECK(page.at(31, 31) > .5f);
  CHECK(page.at(28, 28) < .5f);
}

TEST_CASE("what is drawn decides where the net is in doubt, and the net where it is sure") {
  Page page;
  page.probability.setTo(.5);
  page.drawn(page.square).setTo(255);
  CHECK(page.at(50, 50) > .5f);
  CHECK(page.at(10, 10) < .5f);
  page.probability.setTo(.01);
  CHECK(page.at(50, 50) < .5f);
  page.drawn.setTo(0);
  page.probability(page.square).setTo(.99);
  CHECK(page.at(50, 50) > .5f);
}
