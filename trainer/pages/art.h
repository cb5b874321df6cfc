// Figures and things in pixels, before they are put onto a page in somebody's pens.
#pragma once

#include <opencv2/core.hpp>

#include "libskel/core/rng.h"
#include "trainer/pages/page.h"

namespace skel {

struct Art {
  cv::Mat rgb;           // CV_8UC3
  cv::Mat solid;         // CV_8U, 255 on the art
  bool strokes = false;  // drawn with the lines of a pen, to be left as they are
};

// A figure, its long side so many px.
Art figureArt(Rng& rng, const PageOptions& options, int long_side);
// What is no figure: a house, a tree, a sun, a cloud, a flower, a heart, a ball, an animal, letters.
Art thingArt(Rng& rng, int long_side);

// How somebody draws. The same pens serve for everything on a page.
struct Pens {
  enum class Kind { kPaint, kPrint, kLines, kCrayon };
  Kind kind = Kind::kPaint;
  double strength = 1;   // of the colours, 0…1
  double line_px = 1.5;  // width of lines
  cv::Scalar ink;        // RGB of lines
  double gaps = 0;       // share of a line that is missing
  double grain = 0;      // share of a crayon's area that shows the paper
  double hatch_px = 0;   // from line to line of a hatched fill; 0: an even one
  double wobble_px = 0;  // of a hand that draws lines
};
Pens randomPens(Rng& rng);
// The same, but such that strokes stay strokes.
Pens strokePens(Rng& rng, Pens pens);

// Draws the art with its top left corner at (x, y) of the page, which it may overhang.
void drawArt(Rng& rng, const Pens& pens, const Art& art, int x, int y, cv::Mat& page);

// RGB, each channel in [low, high).
cv::Scalar randomRgb(Rng& rng, double low = 20, double high = 255);

// Values about 0 with deviation 1 that change over `cell` px: CV_32F.
cv::Mat smoothNoise(Rng& rng, const cv::Size& size, int cell);

}  // namespace skel
