// What lines and colours show and what the page net sees, settled pixel by pixel.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// How probably each pixel is figure, CV_32F: the odds of the page net (`probability`, CV_32F) and those of
// `drawn` (8-bit, 255 where lines and colours show a figure), together, smoothed where the picture is even
// and not across its edges (E. S. L. Gastal, M. M. Oliveira, "Domain transform for edge-aware image and video
// processing", 2011, recursive filter): what is surer tells what it is in one piece with. `lab`: the picture
// (labOf(), 8-bit). All of one size.
cv::Mat settled(const cv::Mat& drawn, const cv::Mat& probability, const cv::Mat& lab);

}  // namespace skel
