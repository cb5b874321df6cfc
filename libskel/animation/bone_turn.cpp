#include "libskel/animation/bone_turn.h"

#include <cmath>
#include <numbers>

#include "libskel/animation/shortest_turn.h"
#include "libskel/core/signed_angle.h"
#include "libskel/skeleton/hanging.h"

namespace skel {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

Quaterniond aboutZ(double angle_rad) { return Quaterniond(Eigen::AngleAxisd(angle_rad, Vector3d::UnitZ())); }

bool pointsUp(const Vector3d& canonical) { return canonical.y() > 0; }

double outwards(const Skeleton& skeleton, int joint, double lean_rad) {
  const Vector3d from_root = skeleton.joints[joint].position - skeleton.joints[0].position;
  return (aboutZ(-lean_rad) * from_root).x() < 0 ? -1 : 1;
}

std::vector<Vector3d> restBones(const Skeleton& skeleton) {
  std::vector<Vector3d> bones(skeleton.joints.size(), Vector3d::Zero());
  for (const Joint& child : skeleton.joints)
    if (child.parent >= 0 && hangs(child) == hangs(skeleton.joints[child.parent]))
      bones[child.parent] += child.position - skeleton.joints[child.parent].position;
  for (std::size_t j = 0; j < bones.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    if (bones[j].norm() > 1e-9)
      bones[j].normalize();
    else
      bones[j] = parent >= 0 ? bones[parent] : Vector3d::UnitY();
  }
  return bones;
}

Quaterniond BoneTurn::share(double weight) const {
  return Quaterniond::Identity().slerp(weight, out_of_plane) * aboutZ(weight * angle_rad);
}

BoneTurn boneTurn(const Vector3d& canonical, const Vector3d& drawn, double near_angle_rad) {
  const Vector2d from = canonical.head<2>(), to = drawn.head<2>();
  BoneTurn turn;
  turn.angle_rad = near_angle_rad;
  if (from.norm() > 1e-3 && to.norm() > 1e-3) {
    const double angle = signedAngle(from, to);
    turn.angle_rad =
        angle - 2 * std::numbers::pi *
                    std::floor((angle - near_angle_rad + std::numbers::pi) / (2 * std::numbers::pi));
  }
  turn.out_of_plane = shortestTurn(aboutZ(turn.angle_rad) * canonical, drawn);
  return turn;
}

std::vector<BoneTurn> turnsFromCanonical(const Skeleton& skeleton, const std::vector<Vector3d>& canonical,
                                         const std::vector<double>& ground_rad) {
  std::vector<BoneTurn> turns(skeleton.joints.size());
  const std::vector<Vector3d> bones = restBones(skeleton);
  for (std::size_t j = 0; j < turns.size(); ++j) {
    if (canonical[j].isZero()) continue;
    const int parent = skeleton.joints[j].parent;
    // A limb's first bone may point anywhere but far across the body; the next ones bend from it by less than
    // a half turn.
    const double ground = ground_rad.empty() ? 0 : ground_rad[j];
    double near = 0;
    if (parent >= 0 && !canonical[parent].isZero() && pointsUp(canonical[parent]) == pointsUp(canonical[j]))
      near = turns[parent].angle_rad;
    else if (!pointsUp(canonical[j]))
      near = ground + outwards(skeleton, int(j), ground) * std::numbers::pi / 2;
    turns[j] = boneTurn(canonical[j], bones[j], near);
  }
  return turns;
}

}  // namespace skel
