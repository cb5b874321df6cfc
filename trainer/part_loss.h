// What the part net should say, and its loss.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace skel {

// Mean cross-entropy of the parts' logits (see partLogitIndex()) over the px whose part (CV_8U) is known,
// limbs and what is seldom seen counted more, and that of the log-odds of lying before others on limbs
// of which it is known (1, 0, else -1). Adds `scale` times its derivative to `gradient`, unless that is null.
double partLoss(const std::vector<float>& logits, const cv::Mat& part, const std::array<int, 4>& before,
                double scale, std::vector<float>* gradient);

}  // namespace skel
