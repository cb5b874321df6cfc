#include "libskel/layers/plane_of.h"

#include <opencv2/core.hpp>

namespace skel {

Plane8 planeOf(const cv::Mat& of) {
  return Eigen::Map<const Plane8, Eigen::Unaligned, Eigen::OuterStride<>>(
      of.ptr<std::uint8_t>(), of.rows, of.cols, Eigen::OuterStride<>(static_cast<Eigen::Index>(of.step1())));
}

}  // namespace skel
