// Connected components of masks, with area, box and centre.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace skel {

struct Component {
  int area = 0;        // px
  cv::Rect box;        // of all its pixels
  cv::Point2d centre;  // mean of its pixels
};
struct Components {
  cv::Mat labels;             // 32-bit: an index of `of`
  std::vector<Component> of;  // by the first pixel in reading order; 0: what is not in the mask, empty

  int largest() const;  // the first of them; 0: there is none
};

// As cv::connectedComponentsWithStats() tells, which takes several times as long.
Components componentsOf(const cv::Mat& mask, int connectivity);

}  // namespace skel
