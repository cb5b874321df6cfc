// Clips made for the canonical pose, for a character that was drawn in any other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// From this share of FigureShape::joined on, an arm is one piece with the body.
inline constexpr double kGrownArm = 0.6;
// An arm that takes less than this share along (FigureShape::taken) is a stump that shows nothing.
inline constexpr double kStump = 0.5;

// What there is around the bones (measureFigure() in libskel/deform), as far as motions must know.
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

struct RetargetOptions {
  float rate_hz = 30;         // most keys a second of the result, more than 0; fewer where that shows nowhere
  bool clear_of_head = true;  // raised arms that would pass through the head swing out until they do not
  // Limbs that point at the viewer are stumps in the picture. So much of that way turns into the picture, of
  // a figure in front view: 0 nothing, 1 all of it. By eye on 29 drawings (0, .4 and .8 in hidden order; no
  // difference on 9), .4 was the best of 14 and the worst of 1, 0 the best of 1 and the worst of 12.
  double into_picture = .4;
  // What a body does by itself (ClipFrame::kBody) comes towards the viewer, each limb turned to its own side;
  // with this, limbs turn to the side that the figure rather looks to, as if they were seen aslant, but for
  // arms, or legs, that rather move in the picture than towards the viewer.
  bool aslant = false;
  bool thin_keys = true;                            // where `rate_hz` is more than shows
  std::optional<FigureShape> shape = std::nullopt;  // nothing: shapeOfBones()
};

// The clip as rotations relative to the skeleton's rest pose (Skeleton::joints' positions). Tracks with a
// bone make the drawn bone point where the canonical one would, relative to the trunk; tracks without one are
// added to the drawn pose; joints without a track keep the drawn pose. Limbs are taken out of the drawn pose
// by the way round the outside of the body, never through it, and arms that are folded or on the hips stay
// there. Feet that stand, stay (plant_feet.h). A clip whose rest pose this is stays as it is. Throws
// UsageError if the clip moves a joint that the skeleton lacks, or clip, skeleton or options are none
// (check_clip.h, check_skeleton.h), Error (refused input) if it puts a joint on the ground that is no foot,
// or is too long.
Clip retargetToRest(const Clip& clip, const Skeleton& skeleton, const RetargetOptions& options = {});

// Of names and parents of all joints, and of where they are in the rest pose, to the millimetre: as hex.
std::string restPoseHash(const Skeleton& skeleton);

// What the figure's arms do not do of the clip, which is for the canonical pose: a clause an arm, for the
// user.
std::vector<std::string> armsThatStay(const Clip& clip, const Skeleton& skeleton, const FigureShape& shape);

// Where each joint's bone points in the rest pose: to its child, or to the middle of its children; that of
// its parent for a leaf. Unit vectors.
std::vector<Eigen::Vector3d> restBones(const Skeleton& skeleton);

// The rotation R with R · canonical = drawn, as a planar turn (about z) followed by whatever leaves the
// plane. `near_angle_rad`: the turn is taken in [near − π, near + π).
struct BoneTurn {
  double angle_rad = 0;
  Eigen::Quaterniond out_of_plane = Eigen::Quaterniond::Identity();

  // The share `weight` in [0, 1] of it: 0 is the identity, 1 is R.
  Eigen::Quaterniond share(double weight) const;
};
BoneTurn boneTurn(const Eigen::Vector3d& canonical, const Eigen::Vector3d& drawn, double near_angle_rad);

// The turns that take canonical bones onto those of the rest pose. `canonical`: a direction for each joint,
// zero for those that have none (their turn is the identity). `ground_rad`: how far what each was
// drawn against turns; empty: nothing does.
std::vector<BoneTurn> turnsFromCanonical(const Skeleton& skeleton,
                                         const std::vector<Eigen::Vector3d>& canonical,
                                         const std::vector<double>& ground_rad = {});

}  // namespace skel
