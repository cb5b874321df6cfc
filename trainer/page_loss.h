// What the page net should say, and its loss.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace skel {

// Mean cross-entropy of the pixels' log-odds (see pageLogitIndex()) against the share of each that is figure
// (CV_8U, 255 for all of it), and the Dice loss (Milletari, Navab, Ahmadi, "V-Net", 2016), so that small
// figures count as much as large ones. Adds `scale` times its derivative to `gradient`, unless that is null.
double pageLoss(const std::vector<float>& logits, const cv::Mat& figure, double scale,
                std::vector<float>* gradient);

}  // namespace skel
