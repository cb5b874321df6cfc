#include "libskel/silhouette/settle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr float kDrawn = 2.5f;   // log-odds of what lines and colours say
constexpr float kReach_px = 20;  // of what is known, where the picture is even
constexpr float kEdge = 25;      // a difference of colour (8-bit Lab, summed) that counts as kReach_px
constexpr float kDoubt = .02f;   // of a pixel that nothing is known of
constexpr int kPasses = 3;

using Evidence = cv::Vec2f;  // probability times weight, weight

// Of each pixel, how much of the one before it in its row (column) it takes, in the first pass.
struct Feedback {
  cv::Mat row, column;  // CV_32F
};

Feedback feedbackOf(const cv::Mat& lab) {
  const float deviation =
      kReach_px * std::sqrt(3.f) * float(1 << (kPasses - 1)) / std::sqrt(float((1 << (2 * kPasses)) - 1));
  std::array<float, 3 * 255 + 1> of_difference;
  for (std::size_t i = 0; i < of_difference.size(); ++i)
    of_difference[i] = std::exp(-std::sqrt(2.f) / deviation * (1 + kReach_px / kEdge * float(i)));
  const auto between = [&](const cv::Vec3b& a, const cv::Vec3b& b) {
    return of_difference[std::size_t(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]))];
  };
  Feedback feedback{cv::Mat::zeros(lab.size(), CV_32F), cv::Mat::zeros(lab.size(), CV_32F)};
  for (int y = 0; y < lab.rows; ++y) {
    const cv::Vec3b *here = lab.ptr<cv::Vec3b>(y), *above = lab.ptr<cv::Vec3b>(std::max(0, y - 1));
    float *row = feedback.row.ptr<float>(y), *column = feedback.column.ptr<float>(y);
    for (int x = 1; x < lab.cols; ++x) row[x] = between(here[x], here[x - 1]);
    for (int x = 0; x < lab.cols && y > 0; ++x) column[x] = between(here[x], above[x]);
  }
  return feedback;
}

void alongRows(const cv::Mat& feedback, cv::Mat& evidence) {
  for (int y = 0; y < evidence.rows; ++y) {
    Evidence* e = evidence.ptr<Evidence>(y);
    const float* f = feedback.ptr<float>(y);
    for (int x = 1; x < evidence.cols; ++x) e[x] += f[x] * (e[x - 1] - e[x]);
    for (int x = evidence.cols - 2; x >= 0; --x) e[x] += f[x + 1] * (e[x + 1] - e[x]);
  }
}

void alongColumns(const cv::Mat& feedback, cv::Mat& evidence) {
  const auto pull = [&](int y, int from, const float* f) {
    Evidence* e = evidence.ptr<Evidence>(y);
    const Evidence* other = evidence.ptr<Evidence>(from);
    for (int x = 0; x < evidence.cols; ++x) e[x] += f[x] * (other[x] - e[x]);
  };
  for (int y = 1; y < evidence.rows; ++y) pull(y, y - 1, feedback.ptr<float>(y));
  for (int y = evidence.rows - 2; y >= 0; --y) pull(y, y + 1, feedback.ptr<float>(y + 1));
}

}  // namespace

cv::Mat settled(const cv::Mat& drawn, const cv::Mat& probability, const cv::Mat& lab) {
  SKEL_CHECK(drawn.size() == probability.size() && drawn.size() == lab.size() && lab.type() == CV_8UC3);
  cv::Mat evidence(drawn.size(), CV_32FC2);
  for (int y = 0; y < drawn.rows; ++y)
    for (int x = 0; x < drawn.cols; ++x) {
      constexpr float kLeast = .0005f;
      const float p = std::clamp(probability.at<float>(y, x), kLeast, 1 - kLeast);
      const float odds = std::log(p / (1 - p)) + (drawn.at<std::uint8_t>(y, x) ? kDrawn : -kDrawn);
      const float together = 1 / (1 + std::exp(-odds)), sure = 2 * together - 1;
      const float weight = sure * sure + kDoubt;
      evidence.at<Evidence>(y, x) = {together * weight, weight};
    }
  Feedback feedback = feedbackOf(lab);
  for (int pass = 0; pass < kPasses; ++pass) {
    alongRows(feedback.row, evidence);
    alongColumns(feedback.column, evidence);
    // Half as far in the next.
    feedback.row = feedback.row.mul(feedback.row);
    feedback.column = feedback.column.mul(feedback.column);
  }
  cv::Mat out(drawn.size(), CV_32F);
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      const Evidence& e = evidence.at<Evidence>(y, x);
      out.at<float>(y, x) = e[0] / e[1];
    }
  return out;
}

}  // namespace skel
