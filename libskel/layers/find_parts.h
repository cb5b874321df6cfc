// Which part of the figure each pixel is: what the part net says, with borders on the drawing's own lines.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>

#include "libskel/image/image.h"
#include "libskel/layers/part_net.h"
#include "libskel/mesh/outline.h"

namespace skel {

// The figure's box as the parts are looked for in it. All planes have one size.
struct PartPicture {
  PixelBox box;      // of the image
  double scale = 1;  // its px a px of the image, at most 1
  cv::Mat rgb;       // CV_8UC3, over white
  cv::Mat mask;      // CV_8U, 255 on the figure
  cv::Mat part;      // CV_8U: a Part; on the figure alone
  cv::Mat ink;       // CV_8U, 255 where a line is drawn: darker than what is on both sides of it
  std::array<double, 4> before{};  // probability that the limb lies before what it overlaps
  std::array<double, 4> sure{};    // mean probability of its pixels

  Eigen::Vector2d fromImage(const Eigen::Vector2d& p) const {  // to px with the corner of the first at 0
    return (p + Eigen::Vector2d(.5 - box.x0, .5 - box.y0)) * scale;
  }
  cv::Mat of(Part which) const { return (part == static_cast<int>(which)) & mask; }
};

// `mask`: 255 on the figure, somewhere; `skeleton` in image px, the corner of the first px at 0.
PartPicture findParts(const Image& image, const Plane8& mask, const PartSkeleton& skeleton,
                      const PartNet& net);

}  // namespace skel
