#include "libskel/animation/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "libskel/animation/sample_pose.h"
#include "libskel/core/segment.h"

namespace skel {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Quaterniond aboutZ(double angle_rad) { return Quaterniond(Eigen::AngleAxisd(angle_rad, Vector3d::UnitZ())); }

// How much of the drawn pose is taken back at `time_s`: 0 at the ends of a clip that starts from rest,
// else 1.
double canonicalShare(const Clip& clip, double time_s) {
  if (clip.lead_s <= 0) return 1;
  const double t = std::clamp(std::min(time_s, clip.duration_s() - time_s) / clip.lead_s, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// One moment of the clip on the drawn skeleton.
struct Retargeter {
  const Skeleton& skeleton;
  std::vector<bool> pointed;    // joints whose bone follows the canonical one
  std::vector<BoneTurn> turns;  // canonical to drawn
  std::vector<double> swing;    // extra turn about z of a pointed joint and those below it, radians

  // Rotations to the model frame.
  std::vector<Quaterniond> globals(const Pose& canonical, double share) const {
    const std::size_t count = skeleton.joints.size();
    std::vector<Quaterniond> motion(count), result(count);
    std::vector<double> swung(count, 0);
    for (std::size_t j = 0; j < count; ++j) {
      const int parent = skeleton.joints[j].parent;
      const Quaterniond local = canonical.rotations[j].cast<double>();
      motion[j] = parent < 0 ? local : motion[parent] * local;
      swung[j] = swing[j] + (parent < 0 ? 0 : swung[parent]);
      if (pointed[j])
        result[j] = aboutZ(swung[j] * share) * motion[j] * turns[j].share(share).conjugate();
      else
        result[j] = parent < 0 ? local : result[parent] * local;
    }
    return result;
  }
};

std::vector<Vector3d> positions(const Skeleton& skeleton, const std::vector<Quaterniond>& globals) {
  std::vector<Vector3d> result(skeleton.joints.size());
  for (std::size_t j = 0; j < result.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    result[j] = joint.position;
    if (joint.parent >= 0)
      result[j] = result[joint.parent] +
                  globals[joint.parent] * (joint.position - skeleton.joints[joint.parent].position);
  }
  return result;
}

// Seen from the front, the least turn of the forearm away from the trunk that keeps it and the hand beyond it
// off the head at all `moments`.
double clearingSwing(Retargeter retargeter, const std::vector<std::pair<Pose, double>>& moments, int elbow,
                     int hand) {
  const Skeleton& skeleton = retargeter.skeleton;
  const int head = skeleton.find("head"), top = skeleton.find("head_top");
  if (head < 0 || top < 0) return 0;
  const double radius = (skeleton.joints[top].position - skeleton.joints[head].position).norm();
  const double outwards = skeleton.joints[elbow].position.x() < skeleton.joints[head].position.x() ? 1 : -1;
  constexpr double kHandReach = 1.35;  // the hand's tip, in lengths of the forearm
  constexpr double kStep = kPi / 36;
  constexpr int kSteps = 15;  // no further than 75°
  double best_swing = 0, best_clearance = -1e9;
  for (int step = 0; step <= kSteps; ++step) {
    retargeter.swing[elbow] = outwards * step * kStep;
    double clearance = 1e9;
    for (const auto& [pose, share] : moments) {
      if (share < 1) continue;
      const std::vector<Vector3d> at = positions(skeleton, retargeter.globals(pose, share));
      const Vector2d from = at[elbow].head<2>();
      const Vector2d to = from + kHandReach * (at[hand].head<2>() - from);
      clearance =
          std::min(clearance, distanceToSegment<Vector2d>(at[head].head<2>(), from, to) - 1.1 * radius);
    }
    if (clearance > best_clearance) best_clearance = clearance, best_swing = retargeter.swing[elbow];
    if (clearance >= 0) break;
  }
  return best_swing;
}

}  // namespace

Vector3d restBone(const Skeleton& skeleton, int joint) {
  Vector3d sum = Vector3d::Zero();
  for (const Joint& child : skeleton.joints)
    if (child.parent == joint) sum += child.position - skeleton.joints[joint].position;
  const double length = sum.norm();
  if (length > 1e-9) return sum / length;
  const int parent = skeleton.joints[joint].parent;
  return parent < 0 ? Vector3d(0, 1, 0) : restBone(skeleton, parent);
}

Quaterniond BoneTurn::share(double weight) const {
  return Quaterniond::Identity().slerp(weight, out_of_plane) * aboutZ(weight * angle_rad);
}

BoneTurn boneTurn(const Vector3d& canonical, const Vector3d& drawn, double near_angle_rad) {
  const Vector2d from = canonical.head<2>(), to = drawn.head<2>();
  BoneTurn turn;
  turn.angle_rad = near_angle_rad;
  if (from.norm() > 1e-3 && to.norm() > 1e-3) {
    const double angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    turn.angle_rad = angle - 2 * kPi * std::floor((angle - near_angle_rad + kPi) / (2 * kPi));
  }
  turn.out_of_plane = Quaterniond::FromTwoVectors(aboutZ(turn.angle_rad) * canonical, drawn);
  return turn;
}

std::vector<BoneTurn> turnsFromCanonical(const Skeleton& skeleton, const std::vector<Vector3d>& canonical) {
  std::vector<BoneTurn> turns(skeleton.joints.size());
  for (std::size_t j = 0; j < turns.size(); ++j) {
    if (canonical[j].isZero()) continue;
    const int parent = skeleton.joints[j].parent;
    // A limb's first bone may point anywhere but far across the body; the next ones bend from it by less than
    // a half turn.
    double near = 0;
    if (parent >= 0 && !canonical[parent].isZero())
      near = turns[parent].angle_rad;
    else
      near = (skeleton.joints[j].position.x() < skeleton.joints[0].position.x() ? -1 : 1) * kPi / 2;
    turns[j] = boneTurn(canonical[j], restBone(skeleton, int(j)), near);
  }
  return turns;
}

Clip retargetToRest(const Clip& clip, const Skeleton& skeleton, const RetargetOptions& options) {
  const std::size_t count = skeleton.joints.size();
  std::vector<Vector3d> canonical(count, Vector3d::Zero());
  for (const JointTrack& track : clip.tracks)
    if (const int joint = skeleton.find(track.joint); joint >= 0)
      canonical[joint] = track.bone.cast<double>();

  Retargeter retargeter{skeleton, std::vector<bool>(count), turnsFromCanonical(skeleton, canonical),
                        std::vector<double>(count, 0)};
  for (std::size_t j = 0; j < count; ++j) retargeter.pointed[j] = !canonical[j].isZero();

  const float duration = clip.duration_s();
  const int keys = int(std::ceil(duration * options.rate_hz - 1e-3f)) + 1;
  std::vector<float> times;
  std::vector<std::pair<Pose, double>> moments;
  for (int k = 0; k < keys; ++k) {
    times.push_back(keys == 1 ? 0 : duration * float(k) / float(keys - 1));
    moments.emplace_back(samplePose(clip, skeleton, times.back()), canonicalShare(clip, times.back()));
  }
  if (options.clear_of_head)
    for (const std::string side : {"left_", "right_"}) {
      const int elbow = skeleton.find(side + "elbow"), hand = skeleton.find(side + "hand");
      if (elbow >= 0 && hand >= 0 && retargeter.pointed[elbow])
        retargeter.swing[elbow] = clearingSwing(retargeter, moments, elbow, hand);
    }

  Clip result = clip;
  result.lead_s = 0;
  result.interpolation = RotationInterpolation::kSlerp;
  for (JointTrack& track : result.tracks) {
    const bool turns = !track.times_s.empty() || !track.bone.isZero();
    track.bone.setZero();
    track.times_s = turns ? times : std::vector<float>{};
    track.rotations.clear();
    track.angles_rad.clear();
  }
  for (const auto& [pose, share] : moments) {
    const std::vector<Quaterniond> globals = retargeter.globals(pose, share);
    for (JointTrack& track : result.tracks) {
      if (track.times_s.empty()) continue;
      const int joint = skeleton.index(track.joint), parent = skeleton.joints[joint].parent;
      Quaterniond local =
          parent < 0 ? globals[joint] : (globals[parent].conjugate() * globals[joint]).normalized();
      Eigen::Quaternionf rotation = local.cast<float>().normalized();
      // Neighbouring keys in the same half of the sphere, for programs that interpolate the four numbers.
      if (!track.rotations.empty() ? rotation.dot(track.rotations.back()) < 0 : rotation.w() < 0)
        rotation.coeffs() = -rotation.coeffs();
      track.rotations.push_back(rotation);
    }
  }
  return result;
}

}  // namespace skel
