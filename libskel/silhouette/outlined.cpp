#include "libskel/silhouette/outlined.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/components.h"
#include "libskel/silhouette/strokes.h"
#include "libskel/silhouette/trim.h"

namespace skel {
namespace {

// The lightness that all but a tenth of the picture's border has.
int borderLightness(const cv::Mat& lightness) {
  std::vector<std::uint8_t> values;
  for (int x = 0; x < lightness.cols; ++x) {
    values.push_back(lightness.at<std::uint8_t>(0, x));
    values.push_back(lightness.at<std::uint8_t>(lightness.rows - 1, x));
  }
  for (int y = 0; y < lightness.rows; ++y) {
    values.push_back(lightness.at<std::uint8_t>(y, 0));
    values.push_back(lightness.at<std::uint8_t>(y, lightness.cols - 1));
  }
  const auto tenth = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
  std::nth_element(values.begin(), tenth, values.end());
  return *tenth;
}

// Share of the contour of `figure`, without the border of the picture, that runs along `lines`.
double linedShare(const cv::Mat& figure, const cv::Mat& lines) {
  cv::Mat inner, near_lines;
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, cv::Size(3, 3));
  cv::erode(figure, inner, cross);
  cv::dilate(lines, near_lines, cv::Mat::ones(3, 3, CV_8U));
  const cv::Mat contour = figure & ~inner;
  const int length = cv::countNonZero(contour);
  return length == 0 ? 0 : static_cast<double>(cv::countNonZero(contour & near_lines)) / length;
}

cv::Mat largestPart(const cv::Mat& mask) {
  cv::Mat labels;
  const int largest = largestOf(componentsOf(mask, 4, labels));
  return largest == 0 ? cv::Mat(cv::Mat::zeros(mask.size(), CV_8U)) : cv::Mat(labels == largest);
}

}  // namespace

cv::Mat outlinedFigure(const cv::Mat& lab, const cv::Mat& figure) {
  cv::Mat lightness;
  cv::extractChannel(lab, lightness, 0);
  const int ground = borderLightness(lightness);
  constexpr int kDarkGround = 90;  // on which no outline is darker
  if (ground < kDarkGround) return {};

  // Widest outline 1/40 of the picture.
  const int size = std::max(3, std::max(lab.cols, lab.rows) / 80 * 2 + 1);
  cv::Mat contrast;
  cv::morphologyEx(lightness, contrast, cv::MORPH_BLACKHAT, cv::Mat::ones(size, size, CV_8U));
  const cv::Mat lines = hysteresis(contrast, 20, 45);
  const cv::Mat shown = largestPart(figure);
  if (linedShare(shown, lines) > 0.97) return {};

  const cv::Mat ink = lines | (lightness < ground / 2);
  cv::Mat outlined = ink.clone();
  fillChambers(outlined);
  dropBorderStrips(outlined);
  trimSoftEdge(outlined, ink, ground - lightness);

  const cv::Mat largest = largestPart(outlined);
  const int area = cv::countNonZero(largest), shown_area = cv::countNonZero(shown);
  if (cv::countNonZero(shown ^ largest) < 0.02 * shown_area || area < 0.2 * shown_area) return {};
  const int shown_ink = cv::countNonZero(ink & shown);
  if (cv::countNonZero(ink & shown & largest) < 0.85 * shown_ink) return {};
  // A dark fill without lines, such as hair, is an outline where it encloses the rest from top to bottom.
  const bool encloses = cv::countNonZero(largest & ~ink) > 0.15 * area &&
                        cv::boundingRect(largest).height > 0.8 * cv::boundingRect(shown).height;
  if (!encloses && linedShare(largest, lines) < 0.75) return {};
  return outlined;
}

}  // namespace skel
