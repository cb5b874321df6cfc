// A figure with a dark outline before scenery.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// A second opinion on `figure` (8-bit, 255 on what is not of the background's colours). Where a figure has a
// dark outline, what has none belongs to the scene, whatever its colour: sun, clouds, hills, walls. So the
// background is flooded from the picture's border up to dark lines and dark fills, as in Y. Shu, X. Yang
// (2018), §3.1, but with lines that are told by their contrast and may have gaps (chambers.h).
//
// Empty where `figure` is outlined all around or where no such figure is found: one part with nearly all
// that is dark in `figure`, and lines around it.
cv::Mat outlinedFigure(const cv::Mat& lab, const cv::Mat& figure);

}  // namespace skel
