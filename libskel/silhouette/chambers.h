// Which regions between lines belong to a figure, although its outline may have gaps.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

struct ChamberOptions {
  double widening = 4.0;            // a chamber is at least so many times as wide as the gap that leads to it
  double max_gap = 0.035;           // half the width of such a gap, share of the picture's long side
  double max_stroke = 0.04;         // width of a line, share of the picture's long side
  double min_facing_outside = 0.2;  // share of a chamber's lines that have the outside behind them
};

// Adds to `barrier` (8-bit, 255 on lines and fills) all regions that the barrier encloses, also those that
// are open to the outside by a gap that is narrow beside what lies behind it. Narrow places that lead nowhere
// stay outside.
//
// The distance to the barrier is flooded from its summits down (a watershed with the persistence rule of
// Edelsbrunner, Letscher, Zomorodian 2002, on ratios instead of differences): two regions meet at the middle
// of the gap between them, where their heights and that of the pass tell how much wider they are than the
// gap.
void fillChambers(cv::Mat& barrier, const ChamberOptions& options = {});

}  // namespace skel
