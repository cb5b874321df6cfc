// OpenCV's matrices as planes of ours.
#pragma once

#include "libskel/image/image.h"

namespace cv {
class Mat;
}

namespace skel {

// A copy of a CV_8U matrix, which may be part of another.
Plane8 planeOf(const cv::Mat& of);

}  // namespace skel
