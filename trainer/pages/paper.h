// What lies under and around a drawing, and the light on it.
#pragma once

#include <opencv2/core.hpp>

#include "libskel/core/rng.h"

namespace skel {

// White or coloured paper, plain, ruled, squared or dotted, or a ground as pictures made on a screen have it.
cv::Mat paper(Rng& rng, const cv::Size& size);
// An even ground: white, a scanner's white, one colour, two that run into each other.
cv::Mat evenGround(Rng& rng, const cv::Size& size);
// Light that falls unevenly, folds, the shadow of a hand.
void light(Rng& rng, cv::Mat& page);

// A table, a cloth, a carpet, with things lying about.
cv::Mat table(Rng& rng, const cv::Size& size);
// Puts page and mask onto a table, seen from somewhere above. Both become as large as `size`.
void layOnTable(Rng& rng, const cv::Size& size, cv::Mat& page, cv::Mat& mask);

}  // namespace skel
