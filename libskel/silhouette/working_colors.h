// The picture as the segmentation looks at it: small, opaque, in RGB and in Lab.
#pragma once

#include "libskel/image/image.h"

namespace cv {
class Mat;
}

namespace skel {

// The whole picture as it is, CV_8UC4; its pixels are not copied and not to be written.
cv::Mat rgbaOf(const Image& image);
// The same of a plane, CV_8U.
cv::Mat viewOf(const Plane8& plane);
// An opaque picture. `rgb`: CV_8UC3.
Image imageOfRgb(const cv::Mat& rgb);
inline constexpr int kWorkingSize = 512;  // long side in which figures are found, px
// RGB on white, 8-bit. Larger pictures are reduced.
cv::Mat workingRgb(const Image& image);

// CIE Lab (D65) of sRGB, 8-bit: L·2.55, a + 128, b + 128.
cv::Mat labOf(const cv::Mat& rgb);

}  // namespace skel
