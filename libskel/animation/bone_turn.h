// Where bones point, and how far they are turned from where others do.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <string_view>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

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

// The joints of a person's trunk, and how far they lean and stay as they were drawn (JointTrack::slack_rad)
// where those who lean farther stand up.
inline constexpr std::array<std::string_view, 4> kTrunkJoints = {"pelvis", "body", "neck", "head"};
inline constexpr float kTrunkSlack_rad = float(25 * std::numbers::pi / 180);

Eigen::Quaterniond aboutZ(double angle_rad);
// Of a canonical bone: it is the trunk's, or the head's.
bool pointsUp(const Eigen::Vector3d& canonical);
// To which side of the trunk the joint lies, when that is turned by -`lean_rad`: -1 or 1.
double outwards(const Skeleton& skeleton, int joint, double lean_rad = 0);

}  // namespace skel
