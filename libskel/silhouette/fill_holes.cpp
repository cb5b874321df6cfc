#include "libskel/silhouette/fill_holes.h"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace skel {

void fillHoles(Plane8& mask) {
  const cv::Mat view(static_cast<int>(mask.rows()), static_cast<int>(mask.cols()), CV_8U, mask.data());
  cv::Mat framed;
  cv::copyMakeBorder(view, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  constexpr std::uint8_t kOutside = 128;
  // 8-connected, as the background of a 4-connected figure is.
  cv::floodFill(framed, cv::Point(0, 0), cv::Scalar(kOutside), nullptr, {}, {}, 8);
  for (Eigen::Index y = 0; y < mask.rows(); ++y) {
    const std::uint8_t* row = framed.ptr(static_cast<int>(y) + 1) + 1;
    for (Eigen::Index x = 0; x < mask.cols(); ++x) mask(y, x) = row[x] == kOutside ? 0 : 255;
  }
}

}  // namespace skel
