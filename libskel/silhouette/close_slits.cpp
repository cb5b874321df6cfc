// What a morphological closing (J. Serra, "Image analysis and mathematical morphology", 1982) by a small disc
// adds, where it is long: what it adds in a corner is not.
#include "libskel/silhouette/close_slits.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/components.h"

namespace skel {
namespace {

constexpr double kNarrow = 0.006;  // half as wide, of the figure's long side
constexpr int kLong = 16;          // its area, in squares of half its width

// What is no farther than `reach` px from the mask.
cv::Mat within(const cv::Mat& mask, int reach) {
  constexpr int kSmallDisc = 24;  // the work for each pixel is its area
  if (reach > kSmallDisc) {
    cv::Mat distance;
    cv::distanceTransform(mask == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return distance <= reach;
  }
  cv::Mat disc(2 * reach + 1, 2 * reach + 1, CV_8U), grown;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      disc.at<std::uint8_t>(reach + y, reach + x) = x * x + y * y <= reach * reach;
  cv::dilate(mask, grown, disc);
  return grown;
}

}  // namespace

void closeSlits(Plane8& figure) {
  const auto reach = std::max(
      1,
      static_cast<int>(std::lround(kNarrow * static_cast<double>(std::max(figure.rows(), figure.cols())))));
  cv::Mat view(static_cast<int>(figure.rows()), static_cast<int>(figure.cols()), CV_8U, figure.data());
  cv::Mat framed;
  const int frame = reach + 1;
  cv::copyMakeBorder(view, framed, frame, frame, frame, frame, cv::BORDER_CONSTANT, cv::Scalar(0));
  const cv::Mat added = ~within(~within(framed, reach), reach) & (framed == 0);
  cv::Mat labels;
  const std::vector<Component> slits = componentsOf(added, 8, labels);
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x) {
      const int slit = labels.at<int>(y + frame, x + frame);
      if (slits[static_cast<std::size_t>(slit)].area >= kLong * reach * reach)
        view.at<std::uint8_t>(y, x) = 255;
    }
}

}  // namespace skel
