#include "libskel/video/normalize_figure.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/check.h"
#include "libskel/core/rng.h"

namespace skel {

FrameTransform normalizeFigure(const FrameOutline& outline, double area_px, std::uint64_t seed) {
  SKEL_CHECK(area_px > 0);
  FrameTransform transform;
  if (outline.points.empty()) return transform;
  transform.scale = std::sqrt(area_px / outline.area_px);
  Rng rng(seed);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kOutlineSamples; ++i)
    sum += outline.points[rng.below(std::uint32_t(outline.points.size()))].cast<double>();
  const Eigen::Vector2d middle((outline.width - 1) / 2.0, (outline.height - 1) / 2.0);
  transform.shift = middle - transform.scale * sum / kOutlineSamples;
  return transform;
}

Image transformed(const Image& image, const FrameTransform& t) {
  Image result(image.width, image.height);
  const cv::Mat from(image.height, image.width, CV_8UC4, const_cast<std::uint8_t*>(image.rgba.data()));
  cv::Mat to(image.height, image.width, CV_8UC4, result.rgba.data());
  const cv::Mat matrix = (cv::Mat_<double>(2, 3) << t.scale, 0, t.shift.x(), 0, t.scale, t.shift.y());
  cv::warpAffine(from, to, matrix, to.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(0, 0, 0, 0));
  return result;
}

}  // namespace skel
