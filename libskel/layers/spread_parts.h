// Probabilities of parts, spread as far as the drawing's flat areas go.
#pragma once

#include <vector>

namespace cv {
class Mat;
}

namespace skel {

// What is said of a pixel counts for all that no line and no edge divides from it, the more the nearer: an
// area that is hardly told apart as a whole becomes one part, and borders come to lie on lines. `rgb`
// (CV_8UC3), `mask` (CV_8U, not 0 on the figure): of one size; `range`: of colours on the figure, 0…255.
// `probabilities`: of each part a plane of the same place (CV_32F), finer or coarser than `rgb`, or none, of
// which all px of the figure have their share. Afterwards they are 200 px long at most, in proportion to
// `rgb`, and 0 outside of the figure: what is said of a px holds for those of `rgb` that are nearest to it.
void spreadParts(const cv::Mat& rgb, const cv::Mat& mask, double range, std::vector<cv::Mat>& probabilities);

}  // namespace skel
