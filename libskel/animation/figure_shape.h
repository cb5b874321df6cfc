// What there is around the bones, as far as motions must know.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// From this share of FigureShape::joined on, an arm is one piece with the body.
inline constexpr double kGrownArm = 0.6;
// An arm that takes less than this share along (FigureShape::taken) is a stump that shows nothing.
inline constexpr double kStump = 0.5;

// Measured by measureFigure() (libskel/deform).
struct FigureShape {
  double height_m = kModelHeight_m;
  // About the vertical, from where a figure looks that clips of ClipFrame::kBody are made for to where this
  // one does: 0 for a biped in front view and an animal that looks to the left.
  double yaw_rad = 0;
  // One a joint, or empty. Of an arm: the least angle from straight down outwards at which its bone keeps
  // clear of the trunk. 0 for the others.
  std::vector<double> hang_rad;
  // Half of the head's width, as far as most of it goes, m; 0: by the bones.
  double head_half_width_m = 0;
  // One a joint, or empty. Of a foot: points around what it carries, from the joint, m; a skirt's hem, a cape
  // or a shadow far from it is no foot's. Nothing for the others, and for feet that carry nothing.
  std::vector<std::vector<Eigen::Vector3d>> feet_m;
  // Of a drawing: the side of the picture to which it rather looks, 1 right, -1 left. 0: no drawing.
  double looks = 0;
  // One a joint, or empty; 0…1. Of arms: the share of what is seen from the front where the arm and its hand
  // are drawn, half of it the hand, that the arm takes along. 1 for the others.
  std::vector<double> taken;
  // One a joint, or empty; 0…1. Of arms: the share of the forearm that hangs on the body; 1 for one that
  // moves nothing, or is folded and in one piece with the body. Of legs: how far down they are one piece, 0
  // for trousers, 1 for a gown. 0 for the others.
  std::vector<double> joined;
};
// As much as the bones alone tell.
FigureShape shapeOfBones(const Skeleton& skeleton);
// Folded arms, hands on the hips or in pockets: they lie on the trunk. Found by a forearm that points back to
// the middle.
bool isFolded(const Skeleton& skeleton, int elbow, int hand);
// The y of the foot's lowest point from its joint, m, when the foot is turned so: 0 or less.
double soleBelow(const FigureShape& shape, int foot, const Eigen::Quaterniond& turn);
// FigureShape::joined there; 0 where it is empty.
double joinedAt(const FigureShape& shape, int joint);
// One who was drawn sitting or squatting: the legs lie on the body, no way to stand him up.
bool isSeated(const Skeleton& skeleton, const FigureShape& shape);

}  // namespace skel
