#include "libskel/silhouette/line_art.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/fill_holes.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

constexpr double kLineWidth = 0.024;  // the most, as a share of the long side of what is drawn
constexpr double kWider = 0.35;       // share of what is opaque from which on it is more than lines
constexpr double kEnclosing = 1.5;    // times what is opaque

// Whether what is drawn is lighter than dark.
bool isLight(const Image& image) {
  double light = 0, all = 0;
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i) {
    const auto p = image.rgba.row(i).cast<double>();
    light += p[3] * (p[0] + p[1] + p[2]) / 3;
    all += p[3];
  }
  constexpr double kLight = 170;
  return light > kLight * all;
}

}  // namespace

bool mayBeLineArt(const Plane8& opaque) {
  const cv::Mat drawn = viewOf(opaque);
  const cv::Rect box = cv::boundingRect(drawn);
  if (box.empty()) return false;
  const int area = cv::countNonZero(drawn);
  cv::Mat wide;
  const int half = std::max(1, cvRound(kLineWidth / 2 * std::max(box.width, box.height)));
  cv::erode(drawn(box).clone(), wide, cv::Mat::ones(2 * half + 1, 2 * half + 1, CV_8U), cv::Point(-1, -1), 1,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  if (cv::countNonZero(wide) < kWider * area) return true;
  Plane8 filled = opaque;
  fillHoles(filled);
  return static_cast<double>((filled != 0).count()) >= kEnclosing * area;
}

Image laidOnPaper(Image image) {
  const int paper = isLight(image) ? 40 : 255;
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i) {
    auto p = image.rgba.row(i);
    for (int c = 0; c < 3; ++c)
      p[c] = static_cast<std::uint8_t>((p[c] * p[3] + paper * (255 - p[3]) + 127) / 255);
    p[3] = 255;
  }
  return image;
}

bool needsPaper(const Image& image, const Plane8& mask) {
  const int strongest = image.rgba.col(3).maxCoeff();
  std::int64_t all = 0, seen = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (mask(y, x) != 0) ++all, seen += 2 * image.pixel(x, y)[3] >= strongest;
  return static_cast<double>(all) > kEnclosing * static_cast<double>(seen);
}

}  // namespace skel
