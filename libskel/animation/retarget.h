// Clips made for the canonical pose, for a character that was drawn in any other.
#pragma once

#include "libskel/animation/clip.h"

namespace skel {

struct RetargetOptions {
  float rate_hz = 30;         // keys a second of the result
  bool clear_of_head = true;  // forearms that would pass through the head swing out until they do not
};

// The clip as rotations relative to the skeleton's rest pose (Skeleton::joints' positions). Tracks with a
// bone make the drawn bone point where the canonical one would, relative to the trunk; tracks without one are
// added to the drawn pose; joints without a track keep the drawn pose. Limbs are taken out of the drawn pose
// by the way round the outside of the body, never through it. Throws UsageError if the clip moves a joint
// that the skeleton lacks.
Clip retargetToRest(const Clip& clip, const Skeleton& skeleton, const RetargetOptions& options = {});

// Where the joint's bone points in the rest pose: to its child, or to the middle of its children; that of its
// parent for a leaf. A unit vector.
Eigen::Vector3d restBone(const Skeleton& skeleton, int joint);

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
// zero for those that have none (their turn is the identity).
std::vector<BoneTurn> turnsFromCanonical(const Skeleton& skeleton,
                                         const std::vector<Eigen::Vector3d>& canonical);

}  // namespace skel
