// One figure through the frames of a video: which of two arms is the left one, and which joints are wrong.
//
// The best path through each frame's hypotheses is that of A. Viterbi (1967), of second order: limbs that
// cross go on as they went.
#pragma once

#include <vector>

#include "libskel/style/poses.h"

namespace skel {

// What recognition says of each frame, by itself.
struct JointSightings {
  PoseMatrix places;            // 2J×m, image px
  Eigen::MatrixXd confidences;  // J×m, in [0, 1]; 0: not seen
  // Optional: the colour of the figure at each joint (of a hand or foot, half-way from the joint before),
  // 3J×m, each channel in [0, 1]; else empty. A far leg is often darker than a near one.
  Eigen::MatrixXd colors;
  double figure_px = 1;    // the figure's long side, in which distances are measured
  bool loop = false;       // the first frame follows the last
  double frame_rate = 24;  // frames a second
};

struct TrackOptions {
  // Of smoothSeries(), for 24 frames a second or more; of fewer, in which joints move farther from one to the
  // next, less by the fourth power: what is smoothed is as long in time. 0: joints stay where they are seen.
  double smoothness = 0.6;
};

struct JointTracks {
  PoseMatrix places;               // 2J×m, image px
  Eigen::MatrixXd confidences;     // J×m: of what was seen, how much of it was believed
  std::vector<bool> arms_swapped;  // m: whether left and right of the recognition have changed places
  std::vector<bool> legs_swapped;
};

// Hypotheses of a frame: its arms as they are or swapped, its legs, its shoulders, its hips; all of them is
// the figure mirrored. What is summed over the path does not mix them, so that there is one path for each. Of
// the paths, that on which joints move most evenly and keep their colour, from frame to frame and over all of
// them, and on which most frames are as recognised. Then joints that a body cannot have (bones longer than
// they are in most frames) or that jump out of their way are believed less, and what is left is smoothed,
// each joint relative to its parent. A single frame comes back as it is.
JointTracks trackJoints(const JointSightings& sightings, const SkeletonTemplate& body_plan,
                        const TrackOptions& options = {});

// How evenly joints move: the mean over joints and frames of |p_i−1 − 2 p_i + p_i+1|, as a share of
// `figure_px`. 0 for fewer than three frames.
double unevenness(const PoseMatrix& poses, double figure_px);

}  // namespace skel
