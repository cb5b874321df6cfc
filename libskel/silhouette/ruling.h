// The lines that paper is printed with: ruled and squared paper, margins.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cv {
class Mat;
}

namespace skel {

struct RuledLine {
  bool upright = false;                 // else nearly level
  std::vector<Eigen::Vector2d> points;  // on it, from left to right or from top to bottom, px
};

// Takes thin lines off `rgb` (8-bit) that are nearly level or upright, of nearly one direction and run
// through the picture: eight or more at even distances, or one from border to border. They may bend a little,
// as those of paper that does not lie flat, and may be hidden by what is drawn over half of their way. They
// are returned, in px of `rgb`.
//
// The picture is cut into strips across the lines. In each, the mean darkness along the common direction has
// a peak where a line is; peaks that continue each other from strip to strip are one line. Its pixels take
// the colour that closes over them from both sides (a grey closing across the line), so that strokes that
// cross it stay whole.
std::vector<RuledLine> eraseRuling(cv::Mat& rgb);

}  // namespace skel
