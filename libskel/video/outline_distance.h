// How far apart the outlines of figures are, and which frames of a film differ most from those before.
//
// The Hausdorff distance (F. Hausdorff 1914) by distance transforms (P. Felzenszwalb, D. Huttenlocher 2012):
// one transform a frame, one look-up a point, instead of one distance for each pair of points.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// The figure's pixels that have a neighbour (of 4) outside it, by rows. Beyond the picture is outside.
struct FrameOutline {
  int width = 0, height = 0;  // px, of the picture
  std::vector<Eigen::Vector2i> points;
  int area_px = 0;  // of the figure
};
FrameOutline outlineOf(const Plane8& mask);

// px: the farthest that a point of either outline is from the other one. 0 if both are empty, the diagonal of
// the picture if one is. Pictures of the same size.
double hausdorffDistance(const FrameOutline& a, const FrameOutline& b);

// Between each frame and the next, n − 1 entries, px.
Eigen::VectorXd successiveDistances(const std::vector<FrameOutline>& outlines, int threads = 0);

// Between all frames, n×n, symmetric, px. `on_frame` is called after each, by several threads; may be empty.
Eigen::MatrixXd distanceMatrix(const std::vector<FrameOutline>& outlines, int threads = 0,
                               const std::function<void()>& on_frame = {});

// The first frame, the last, and each that differs from the one before by more than `threshold` of the
// largest such difference (patent CN102231209A). `successive`: px; `largest`: what they are divided by, > 0,
// or 0 for their own largest. Frames that are all the same give the first and the last.
std::vector<int> keyFrames(const Eigen::VectorXd& successive, double threshold, double largest = 0);

}  // namespace skel
