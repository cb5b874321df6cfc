// Drawings on pages with what makes it hard to tell them from their ground, one circumstance at a time, and
// where they lie. Shares no code with the pages that the page net learns from (page.h), so that it can
// measure that net.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "libskel/core/rng.h"
#include "libskel/image/image.h"

namespace skel {

struct HardPage {
  cv::Mat rgb;                   // CV_8UC3
  std::vector<cv::Mat> figures;  // CV_8U, 255 on each
  cv::Mat drawn;                 // CV_8UC3, the drawings alone, on white in even light
};

struct PageArt {
  cv::Mat rgb, cover, mask;  // over white; 0…1 CV_32F; 255 on the figure
};

// `mask`: 255 on the figure, of the picture.
PageArt pageArt(const Image& image, const Plane8& mask);

struct Circumstance {
  const char* name;
  // The same page for the same state of rng. `other` joins where a page has two figures.
  std::function<HardPage(Rng&, const PageArt& art, const PageArt& other)> compose;
};

// White and coloured grounds, pencil, gaps, pieces, a cut figure, shadows, ruling, scenery, two figures, a
// table.
std::vector<Circumstance> circumstances();

// Of the figure that `mask`, of the page, meets best.
double overlapOnPage(const HardPage& page, const Plane8& mask);

}  // namespace skel
