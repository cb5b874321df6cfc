#include "libskel/cutout/flat_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "libskel/core/check.h"
#include "libskel/core/signed_angle.h"
#include "libskel/core/smooth_step.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Shares of a bone's length on the screen: one that shows less points at the viewer, and where it points in
// the picture says nothing.
constexpr double kStump = 0.15, kSeen = 0.45;

// Of each joint, whether it is the head or carries it.
std::vector<bool> wayToHead(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  std::vector<bool> to_head(skeleton.joints.size(), false);
  if (body_plan.head >= 0)
    for (int j = skeleton.find(body_plan.joints[std::size_t(body_plan.head)].name); j >= 0;
         j = skeleton.joints[std::size_t(j)].parent)
      to_head[std::size_t(j)] = true;
  return to_head;
}

// The joint that each joint's bone leads to: towards the head, where there is a way, else the first one. -1:
// it has none.
std::vector<int> boneEnds(const Skeleton& skeleton, const std::vector<bool>& to_head) {
  std::vector<int> ends(skeleton.joints.size(), -1);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (const int parent = skeleton.joints[j].parent; parent >= 0)
      if (int& end = ends[std::size_t(parent)]; end < 0 || to_head[j]) end = int(j);
  return ends;
}

constexpr double kDegree = std::numbers::pi / 180;
// Between the bones of a limb, 0 straight: up to the first it bends as it is told, and never much above the
// first two, but for an elbow that is beyond the third, on its way through folded to the other side.
constexpr double kBend_rad = 75 * kDegree, kFold_rad = 35 * kDegree, kThrough_rad = 140 * kDegree;

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

// A knee or an elbow that bends no farther than a flat limb may that is drawn as bent as `drawn_rad`: folded,
// its second half hides the first or is hidden by it. An elbow that goes on through folded does so quickly.
double bent(double angle_rad, double drawn_rad, bool is_elbow) {
  const double sharp = std::abs(angle_rad);
  const double free = std::max(kBend_rad, std::abs(drawn_rad)), over = sharp - free;
  if (over <= 0) return angle_rad;
  const double held = free + kFold_rad * std::tanh(over / kFold_rad);
  const double through = is_elbow ? smoothStep(kThrough_rad, std::numbers::pi, sharp) : 0;
  return std::copysign(held + through * (sharp - held), angle_rad);
}

// Of what it stands on.
std::vector<std::size_t> feetOf(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  std::vector<std::size_t> feet;
  for (const TemplateLimb& limb : body_plan.limbs)
    if (const int foot = skeleton.find(body_plan.joints[std::size_t(limb.joints[2])].name);
        foot >= 0 && isLeg(body_plan, limb))
      feet.push_back(std::size_t(foot));
  return feet;
}

double lowestOf(const FlatPose& pose, const std::vector<std::size_t>& joints) {
  double lowest = 1e300;
  for (const std::size_t joint : joints) lowest = std::min(lowest, pose.place[joint].y());
  return lowest;
}

// How far the figure must be moved for its lowest foot to be as low as in space, and for those that are down
// to be where they are there, in the mean.
Vector2d offGround(const Skeleton& skeleton, const SkeletonTemplate& body_plan, const FlatPose& pose,
                   const std::vector<Eigen::Vector3f>& posed) {
  constexpr double kDown = 0.03;  // above the lowest foot, of the height of the root
  const double down = kDown * std::max(1e-6, std::abs(skeleton.joints[0].position.y()));
  const std::vector<std::size_t> feet = feetOf(skeleton, body_plan);
  if (feet.empty()) return Vector2d::Zero();
  double lowest = 1e300;
  for (const std::size_t foot : feet) lowest = std::min(lowest, double(posed[foot].y()));
  double aside = 0, weights = 0;
  for (const std::size_t foot : feet) {
    const double weight = std::exp(-(double(posed[foot].y()) - lowest) / down);
    aside += weight * (double(posed[foot].x()) - pose.place[foot].x());
    weights += weight;
  }
  return {aside / weights, lowest - lowestOf(pose, feet)};
}

}  // namespace

Vector2d FlatPose::moved(std::size_t joint, const Vector2d& p) const {
  return place[joint] + Eigen::Rotation2Dd(turn_rad[joint]) * (p - rest[joint]);
}

FlatPose flatPose(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                  const JointTransforms& posed_from_rest) {
  const std::size_t count = skeleton.joints.size();
  const std::vector<bool> to_head = wayToHead(skeleton, body_plan);
  const std::vector<int> ends = boneEnds(skeleton, to_head);
  const std::vector<Eigen::Vector3f> posed = posedJoints(skeleton, posed_from_rest);

  enum class Bend { kNone, kKnee, kElbow };
  std::vector<Bend> bends(count, Bend::kNone);
  for (const TemplateLimb& limb : body_plan.limbs)
    if (const int j = skeleton.find(body_plan.joints[std::size_t(limb.joints[1])].name); j >= 0)
      bends[std::size_t(j)] = isLeg(body_plan, limb) ? Bend::kKnee : Bend::kElbow;

  FlatPose pose;
  std::vector<Vector3d> bones(count);
  for (std::size_t j = 0; j < count; ++j) {
    const Joint& joint = skeleton.joints[j];
    const std::size_t parent = std::size_t(std::max(0, joint.parent));
    const int end = ends[j];
    Vector3d along =
        end >= 0 ? Vector3d(skeleton.joints[std::size_t(end)].position - joint.position) : bones[parent];
    // Trunk and head lie in the picture, however deep their joints are in the model: who turns the head to
    // the side does not roll it.
    if (to_head[j]) along.z() = 0;
    bones[j] = along.norm() > 1e-9 ? Vector3d(along.normalized()) : Vector3d::UnitY();
    const Vector3d turned = posed_from_rest[j].linear().cast<double>() * bones[j];
    const double carried = joint.parent < 0 ? 0 : pose.turn_rad[parent];
    const Vector2d before = bones[j].head<2>(), after = turned.head<2>();
    const double shown = std::min(before.norm(), after.norm());
    const double own = signedAngle(before, after);
    double turn = smoothStep(kStump, kSeen, shown) * wrapped(own - carried);
    if (bends[j] != Bend::kNone && joint.parent >= 0) {
      const double drawn = signedAngle(bones[parent].head<2>(), before);
      turn = bent(wrapped(drawn + turn), drawn, bends[j] == Bend::kElbow) - drawn;
    }
    pose.turn_rad.push_back(carried + turn);
    pose.rest.push_back(joint.position.head<2>());
    pose.place.push_back(joint.parent < 0 ? Vector2d(posed[j].head<2>().cast<double>())
                                          : pose.moved(parent, pose.rest[j]));
  }
  const Vector2d off = offGround(skeleton, body_plan, pose, posed);
  for (Vector2d& place : pose.place) place += off;
  return pose;
}

FlatPose flatPose(const Skeleton& skeleton, const SkeletonTemplate& body_plan, std::vector<Vector2d> places) {
  SKEL_CHECK_EQ(places.size(), skeleton.joints.size());
  const std::vector<int> ends = boneEnds(skeleton, wayToHead(skeleton, body_plan));
  FlatPose pose;
  pose.place = std::move(places);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    pose.rest.push_back(joint.position.head<2>());
    const double carried = joint.parent < 0 ? 0 : pose.turn_rad[std::size_t(joint.parent)];
    double turn = carried;
    if (ends[j] >= 0) {
      const std::size_t end = std::size_t(ends[j]);
      const Vector2d before = skeleton.joints[end].position.head<2>() - pose.rest[j],
                     after = pose.place[end] - pose.place[j];
      if (before.norm() > 1e-9 && after.norm() > 1e-9) turn += wrapped(signedAngle(before, after) - carried);
    }
    pose.turn_rad.push_back(turn);
  }
  return pose;
}

FlatPose calmed(const FlatPose& pose, const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                double legs, double rest) {
  std::vector<double> shares(skeleton.joints.size(), rest);
  for (const TemplateLimb& limb : body_plan.limbs) {
    if (!isLeg(body_plan, limb)) continue;
    for (const int joint : limb.joints)
      if (const int j = skeleton.find(body_plan.joints[std::size_t(joint)].name); j >= 0)
        shares[std::size_t(j)] = legs;
  }
  FlatPose calm = pose;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    const auto carrier = std::size_t(std::max(0, parent));
    const double own = pose.turn_rad[j] - (parent < 0 ? 0 : pose.turn_rad[carrier]);
    calm.turn_rad[j] = (parent < 0 ? 0 : calm.turn_rad[carrier]) + shares[j] * own;
    if (parent >= 0) calm.place[j] = calm.moved(carrier, calm.rest[j]);
  }
  const std::vector<std::size_t> feet = feetOf(skeleton, body_plan);
  if (feet.empty()) return calm;
  const Vector2d off(0, lowestOf(pose, feet) - lowestOf(calm, feet));
  for (Vector2d& place : calm.place) place += off;
  return calm;
}

}  // namespace skel
