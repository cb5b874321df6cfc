// Connected components of masks, with area, box and centre.
#pragma once

#include <vector>

namespace cv {
class Mat;
}

namespace skel {

struct Component {
  int area = 0;                             // px
  int x = 0, y = 0, width = 0, height = 0;  // its box
  double centre_x = 0, centre_y = 0;        // mean of its pixels
};

// As cv::connectedComponentsWithStats() tells, which takes several times as long: by label, which `labels`
// (32-bit) says of each pixel. Label 0, what is not in the mask, stays empty.
std::vector<Component> componentsOf(const cv::Mat& mask, int connectivity, cv::Mat& labels);

// The label of the first of the largest; 0: there is none.
int largestOf(const std::vector<Component>& components);

}  // namespace skel
