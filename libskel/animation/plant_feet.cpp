#include "libskel/animation/plant_feet.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "libskel/animation/shortest_turn.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// One time that a foot stands; `to_s` may lie beyond the motion's end, which is its beginning.
struct Stand {
  int foot;
  double from_s, to_s;
  Vector3d place;  // of the foot's joint in the middle of it

  double middle_s() const { return (from_s + to_s) / 2; }
};

std::vector<Stand> standsOf(const Skeleton& skeleton, const std::vector<FootContact>& contacts,
                            double duration_s) {
  constexpr double kSame_s = 1e-3;
  std::vector<Stand> stands;
  for (const FootContact& contact : contacts)
    stands.push_back({skeleton.index(contact.joint), contact.from_s, contact.to_s, Vector3d::Zero()});
  // One that ends with the motion goes on at its beginning.
  for (std::size_t a = 0; a < stands.size(); ++a)
    for (std::size_t b = 0; b < stands.size(); ++b)
      if (a != b && stands[a].foot == stands[b].foot && stands[a].to_s > duration_s - kSame_s &&
          stands[b].from_s < kSame_s && stands[b].to_s < stands[a].from_s) {
        stands[a].to_s = duration_s + stands[b].to_s;
        stands.erase(stands.begin() + std::ptrdiff_t(b));
        a = b = 0;
      }
  return stands;
}

// `time_s`, or the same moment of a later or earlier round, nearest to the middle of the stand.
double nearestRound(const Stand& stand, double time_s, double duration_s) {
  return time_s + duration_s * std::round((stand.middle_s() - time_s) / duration_s);
}

// 1 while it lasts, 0 well before and after.
double weightAt(const Stand& stand, double time_s, double duration_s, double ramp_s) {
  if (stand.to_s - stand.from_s > duration_s - 1e-3) return 1;
  const double t = nearestRound(stand, time_s, duration_s);
  const double outside = std::max({stand.from_s - t, t - stand.to_s, 0.0});
  if (outside < 1e-4) return 1;
  const double share = std::clamp(1 - outside / ramp_s, 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

// How far the joint's bone reaches.
double boneLength(const Skeleton& skeleton, int child) {
  return (skeleton.joints[child].position - skeleton.joints[skeleton.joints[child].parent].position).norm();
}

// From the parent's.
Vector3d placeOf(const Skeleton& skeleton, const ModelPose& pose, const Joint& joint,
                 const Vector3d& parent_at) {
  return parent_at + pose.globals[joint.parent] * (joint.position - skeleton.joints[joint.parent].position);
}

// Turns the two bones above `foot` so that it comes to lie at `goal`, or as near as they reach.
void reach(const Skeleton& skeleton, int foot, const Vector3d& goal, const Vector3d& forwards,
           ModelPose& pose) {
  const int knee = skeleton.joints[foot].parent, hip = skeleton.joints[knee].parent;
  const Vector3d hip_at = jointPosition(skeleton, pose, hip),
                 knee_at = placeOf(skeleton, pose, skeleton.joints[knee], hip_at),
                 foot_at = placeOf(skeleton, pose, skeleton.joints[foot], knee_at);
  const double upper = boneLength(skeleton, knee), lower = boneLength(skeleton, foot);
  const Vector3d way = goal - hip_at;
  if (!(upper > 1e-6 && lower > 1e-6 && way.norm() > 1e-6)) return;
  const double least = std::abs(upper - lower) + 1e-4 * (upper + lower);
  const double length = std::clamp(way.norm(), least, 0.9999 * (upper + lower));
  const Vector3d axis = way.normalized();
  // The knee keeps to the side where it is, and a straight one bends forwards.
  const Vector3d leg = (foot_at - hip_at).normalized();
  Vector3d bend = knee_at - hip_at;
  bend -= bend.dot(leg) * leg;
  bend += 0.1 * (upper + lower) * forwards;
  bend -= bend.dot(axis) * axis;
  if (!(bend.norm() > 1e-9)) return;
  const double along = (upper * upper - lower * lower + length * length) / (2 * length);
  const double aside = std::sqrt(std::max(0.0, upper * upper - along * along));
  const Vector3d knee_goal = hip_at + along * axis + aside * bend.normalized();
  const Vector3d foot_goal = hip_at + length * axis;
  const Quaterniond upper_turn = shortestTurn(knee_at - hip_at, knee_goal - hip_at);
  const Quaterniond lower_turn = shortestTurn(foot_at - knee_at, foot_goal - knee_goal);
  pose.globals[hip] = (upper_turn * pose.globals[hip]).normalized();
  pose.globals[knee] = (lower_turn * pose.globals[knee]).normalized();
  pose.globals[foot] = (lower_turn * pose.globals[foot]).normalized();
}

// How far the root must come down for the leg to reach `goal`.
double lowering(const Skeleton& skeleton, int foot, const Vector3d& goal, const Vector3d& hip_at) {
  const double reach_m =
      0.998 * (boneLength(skeleton, foot) + boneLength(skeleton, skeleton.joints[foot].parent));
  const Vector3d way = hip_at - goal;
  if (way.norm() <= reach_m) return 0;
  const double aside2 = way.x() * way.x() + way.z() * way.z();
  return std::max(0.0, way.y() - std::sqrt(std::max(0.0, reach_m * reach_m - aside2)));
}

// Nowhere less, and without jerks. Round: the end is the beginning.
std::vector<double> smoothedUpper(const std::vector<double>& values) {
  const int count = int(values.size());
  if (*std::max_element(values.begin(), values.end()) <= 0) return values;
  constexpr int kReach = 3;
  const auto around = [&](const std::vector<double>& of, int i) { return of[(i % count + count) % count]; };
  std::vector<double> upper(values), smooth(values);
  for (int i = 0; i < count; ++i)
    for (int d = -kReach; d <= kReach; ++d) upper[i] = std::max(upper[i], around(values, i + d));
  for (int i = 0; i < count; ++i) {
    double sum = 0, weights = 0;
    for (int d = -kReach; d <= kReach; ++d) {
      const double weight = kReach + 1 - std::abs(d);
      sum += weight * around(upper, i + d);
      weights += weight;
    }
    smooth[i] = sum / weights;
  }
  return smooth;
}

// How much higher, in what it is lifted, a foot has to be lifted that steps: while another one stands.
double liftGain(const Skeleton& skeleton, int foot, const std::vector<Stand>& stands,
                const FootPlanting& planting, const std::vector<ModelPose>& poses,
                const std::vector<double>& lifts_m) {
  constexpr double kMostOfLeg = 0.5, kNoStep = 0.02;
  double highest = 0;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    bool stands_here = false, stands_there = false;
    for (const Stand& stand : stands)
      (stand.foot == foot ? stands_here : stands_there) |=
          weightAt(stand, poses[k].time_s, poses.back().time_s, planting.ramp_s) >= 1;
    if (!stands_here && stands_there) highest = std::max(highest, lifts_m[k]);
  }
  const double leg_m = boneLength(skeleton, foot) + boneLength(skeleton, skeleton.joints[foot].parent);
  if (highest < kNoStep * leg_m) return 0;
  return std::max(0.0, std::min(planting.least_lift_m, kMostOfLeg * leg_m) / highest - 1);
}

}  // namespace

std::vector<Vector3d> jointPositions(const Skeleton& skeleton, const ModelPose& pose) {
  std::vector<Vector3d> result;
  result.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints)
    result.push_back(joint.parent < 0 ? Vector3d(joint.position + pose.root_offset_m)
                                      : placeOf(skeleton, pose, joint, result[joint.parent]));
  return result;
}

Vector3d jointPosition(const Skeleton& skeleton, const ModelPose& pose, int joint) {
  const Joint& own = skeleton.joints[joint];
  return own.parent < 0 ? Vector3d(own.position + pose.root_offset_m)
                        : placeOf(skeleton, pose, own, jointPosition(skeleton, pose, own.parent));
}

void plantFeet(const Skeleton& skeleton, const std::vector<FootContact>& contacts,
               const FootPlanting& planting, std::vector<ModelPose>& poses) {
  if (contacts.empty() || poses.size() < 2) return;
  // The last pose is the first of the next round.
  const std::size_t count = poses.size() - 1;
  const double duration_s = poses.back().time_s;
  std::vector<Stand> stands = standsOf(skeleton, contacts, duration_s);

  std::vector<std::vector<Vector3d>> at;
  for (const ModelPose& pose : poses) at.push_back(jointPositions(skeleton, pose));

  // How the ground runs: as the standing feet do, taken together.
  Vector3d run = Vector3d::Zero();
  double stood_s = 0;
  const auto poseAt = [&](double time_s) {
    const double k = std::fmod(time_s, duration_s) / duration_s * double(count);
    return std::min(std::size_t(std::lround(k)), count);
  };
  for (const Stand& stand : stands) {
    if (stand.to_s - stand.from_s > duration_s - 1e-3) continue;
    run += at[poseAt(stand.to_s)][stand.foot] - at[poseAt(stand.from_s)][stand.foot];
    stood_s += stand.to_s - stand.from_s;
  }
  if (stood_s > 0) run /= stood_s;
  run.y() = 0;

  for (Stand& stand : stands) {
    int seen = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double t = nearestRound(stand, poses[k].time_s, duration_s);
      if (t < stand.from_s - 1e-4 || t > stand.to_s + 1e-4) continue;
      stand.place += at[k][stand.foot] - (t - stand.middle_s()) * run;
      ++seen;
    }
    if (seen > 0) stand.place /= seen;
    stand.place.y() = planting.standing_y_m[stand.foot];
  }
  const auto goalOf = [&](const Stand& stand, double time_s) {
    return Vector3d(stand.place + (nearestRound(stand, time_s, duration_s) - stand.middle_s()) * run);
  };

  std::vector<double> lower(count, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (const Stand& stand : stands) {
      if (weightAt(stand, poses[k].time_s, duration_s, planting.ramp_s) < 1) continue;
      const int hip = skeleton.joints[skeleton.joints[stand.foot].parent].parent;
      lower[k] =
          std::max(lower[k], lowering(skeleton, stand.foot, goalOf(stand, poses[k].time_s), at[k][hip]));
    }
  lower = smoothedUpper(lower);

  struct Step {
    std::vector<double> lifts_m;  // one a pose: how high above where it stands
    double gain = 0;
  };
  std::map<int, Step> steps;  // by foot
  for (const Stand& stand : stands) {
    if (steps.contains(stand.foot)) continue;
    Step& step = steps[stand.foot];
    for (std::size_t k = 0; k <= count; ++k)
      step.lifts_m.push_back(at[k][stand.foot].y() - lower[k % count] - planting.standing_y_m[stand.foot]);
    step.gain = liftGain(skeleton, stand.foot, stands, planting, poses, step.lifts_m);
  }

  for (std::size_t k = 0; k <= count; ++k) {
    ModelPose& pose = poses[k];
    pose.root_offset_m.y() -= pose.share * lower[k % count];
    for (const auto& [foot, step] : steps) {
      if (step.gain > 0 && step.lifts_m[k] > 0) {
        const Vector3d up(0, pose.share * step.gain * step.lifts_m[k], 0);
        reach(skeleton, foot, jointPosition(skeleton, pose, foot) + up, planting.forwards[foot], pose);
      }
      if (planting.as_drawn > 0)
        pose.globals[foot] =
            pose.globals[foot].slerp(pose.share * planting.as_drawn, planting.standing_turn[foot]);
    }
    for (const Stand& stand : stands) {
      const double time_s = k == count ? poses[0].time_s : pose.time_s;
      const double weight = pose.share * weightAt(stand, time_s, duration_s, planting.ramp_s);
      if (weight <= 0) continue;
      const Vector3d now = jointPosition(skeleton, pose, stand.foot);
      reach(skeleton, stand.foot, now + weight * (goalOf(stand, time_s) - now), planting.forwards[stand.foot],
            pose);
      pose.globals[stand.foot] = pose.globals[stand.foot].slerp(weight, planting.standing_turn[stand.foot]);
    }
    // A swinging foot does not go below the ground.
    for (const Stand& stand : stands) {
      const Vector3d now = jointPosition(skeleton, pose, stand.foot);
      const double depth = planting.standing_y_m[stand.foot] - now.y();
      if (depth > 1e-4 && pose.share > 0)
        reach(skeleton, stand.foot, now + Vector3d(0, pose.share * depth, 0), planting.forwards[stand.foot],
              pose);
    }
  }
}

}  // namespace skel
