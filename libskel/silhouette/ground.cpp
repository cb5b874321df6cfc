#include "libskel/silhouette/ground.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/components.h"

namespace skel {
namespace {

constexpr double kThickest = 0.014;  // of a line of ground, share of the picture's long side
constexpr double kFlattest = 0.12;   // its height against its length, at most
constexpr double kLowest = 0.75;     // where it may begin, share of the figure's height from its top
constexpr double kLongest = 0.12;  // the longest part that sticks out, share of the figure's height, at least
constexpr double kTogether = 0.2;  // and all of them

struct Part {
  int label, area;
  cv::Rect box;
};

// Those of a mask, by label.
std::vector<Part> partsOf(const cv::Mat& mask, int connectivity, cv::Mat& labels) {
  std::vector<Part> parts;
  for (const Component& c : componentsOf(mask, connectivity, labels))
    if (c.area > 0)
      parts.push_back({static_cast<int>(parts.size()) + 1, c.area, {c.x, c.y, c.width, c.height}});
  return parts;
}

// y = height + slope·x through the middle of the pixels of the parts (least squares).
struct Level {
  double height = 0, slope = 0;
  double at(double x) const { return height + slope * x; }
};

Level levelThrough(const cv::Mat& labels, const std::vector<Part>& parts) {
  double n = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (const Part& part : parts) {
    for (int y = part.box.y; y < part.box.br().y; ++y) {
      for (int x = part.box.x; x < part.box.br().x; ++x) {
        if (labels.at<int>(y, x) != part.label) continue;
        n += 1, x_sum += x, y_sum += y, xx += static_cast<double>(x) * x, xy += static_cast<double>(x) * y;
      }
    }
  }
  Level level;
  level.slope = (n * xy - x_sum * y_sum) / std::max(1.0, n * xx - x_sum * x_sum);
  level.height = (y_sum - level.slope * x_sum) / n;
  return level;
}

}  // namespace

bool dropGround(cv::Mat& figure, const cv::Mat& lines) {
  cv::Mat labels;
  const std::vector<Part> figures = partsOf(figure, 8, labels);
  if (figures.empty()) return false;
  const Part whole = *std::max_element(figures.begin(), figures.end(),
                                       [](const Part& a, const Part& b) { return a.area < b.area; });

  const int thickest = std::max(3, cvRound(kThickest * std::max(figure.cols, figure.rows)));
  cv::Mat bulk;
  const cv::Size size(1, thickest + 2);  // what is higher than a line is none
  cv::morphologyEx(figure, bulk, cv::MORPH_OPEN, cv::Mat::ones(size, CV_8U));
  std::vector<Part> flat;
  for (const Part& part : partsOf(figure & ~bulk, 8, labels)) {
    if (part.box.width < 4 * thickest / 2 || part.box.height > thickest + kFlattest * part.box.width ||
        part.box.y < whole.box.y + kLowest * whole.box.height || (part.box & whole.box).area() == 0)
      continue;
    flat.push_back(part);
  }
  if (flat.empty()) return false;
  std::stable_sort(flat.begin(), flat.end(),
                   [](const Part& a, const Part& b) { return a.box.width > b.box.width; });
  if (flat.front().box.width < kLongest * whole.box.height) return false;
  Level level = levelThrough(labels, {flat.front()});
  std::vector<Part> ground;
  int length = 0, left = figure.cols, right = 0;
  for (const Part& part : flat) {
    const double x = part.box.x + part.box.width / 2.0, y = part.box.y + part.box.height / 2.0;
    if (std::abs(level.at(x) - y) > 1.5 * thickest) continue;
    ground.push_back(part);
    length += part.box.width;
    left = std::min(left, part.box.x);
    right = std::max(right, part.box.br().x);
  }
  if (length < kTogether * whole.box.height) return false;
  level = levelThrough(labels, ground);

  cv::Mat band = cv::Mat::zeros(figure.size(), CV_8U);
  const int half = thickest / 2 + 2;
  for (int x = left; x < right; ++x) {
    const int middle = cvRound(level.at(x));
    for (int y = std::max(0, middle - half); y <= std::min(figure.rows - 1, middle + half); ++y)
      band.at<std::uint8_t>(y, x) = 255;
  }
  cv::Mat cut = lines & ~band;
  fillChambers(cut);
  for (const Part& part : ground) {
    // A line that bends leaves the band.
    cv::Mat own = cut(part.box);
    own.setTo(0, labels(part.box) == part.label);
  }
  // What only the line closes is paper between legs where something of the figure stands on either side, else
  // a part of the figure that has the line for a sole.
  const cv::Mat inner = figure & ~lines & ~band;
  const cv::Mat closed = figure & ~cut & ~band;
  const auto standsIn = [&](int x0, int x1, int y0, int y1) {
    const cv::Rect place = cv::Rect(cv::Point(x0, y0), cv::Point(x1, y1)) & cv::Rect({}, figure.size());
    return place.area() > 0 && cv::countNonZero(inner(place)) >= 2 * thickest;
  };
  cv::Mat kept = cv::Mat::zeros(figure.size(), CV_8U);
  for (const Part& part : partsOf(closed, 4, labels)) {
    const int low = part.box.br().y, high = low - std::max(2 * thickest, part.box.height / 4);
    const bool at_line = std::abs(low - level.at(part.box.x + part.box.width / 2.0)) < 2 * half;
    if (!at_line || part.area < thickest * thickest) continue;
    const bool between = standsIn(whole.box.x, part.box.x, high, low) &&
                         standsIn(part.box.br().x, whole.box.br().x, high, low);
    if (!between) kept |= labels == part.label;
  }
  cv::Mat soles;
  cv::dilate(kept | (cut & ~lines), soles, cv::Mat::ones(4 * half + 1, 1, CV_8U));
  figure = cut | kept | (soles & figure & band & lines);
  return true;
}

}  // namespace skel
