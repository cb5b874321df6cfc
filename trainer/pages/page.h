// Random pages with a figure on them, as people photograph and scan them, with exact truth: what the page net
// is trained on.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "libskel/core/rng.h"
#include "trainer/figures/figure.h"

namespace skel {

struct Page {
  cv::Mat rgb;     // CV_8UC3, its long side kPageNetSize px
  cv::Mat figure;  // CV_8U, of the same size: the share of each px that is figure, 255 for all of it
};

struct PageOptions {
  std::vector<SmallDrawing> drawings;  // some figures come from these, the others from figurePlans()
  double drawn_share = 0;
};

// The same page for the same state of rng and the same build.
Page generatePage(Rng& rng, const PageOptions& options);

}  // namespace skel
