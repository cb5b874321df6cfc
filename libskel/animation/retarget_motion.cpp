#include "libskel/animation/retarget_motion.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "libskel/animation/joint_roles.h"
#include "libskel/animation/plant_feet.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"

namespace skel {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Which joint of theirs moves each of ours, -1: none; and whether all names are ours.
struct Mapping {
  std::vector<int> theirs;
  bool same_names = false, by_shape = false;
};

Mapping mapJoints(const BvhMotion& motion, const std::string& file, const Skeleton& target) {
  Mapping mapping;
  for (const Joint& joint : target.joints) mapping.theirs.push_back(motion.skeleton.find(joint.name));
  mapping.same_names = std::count(mapping.theirs.begin(), mapping.theirs.end(), -1) == 0;
  if (mapping.same_names) return mapping;
  const JointRoles ours = findJointRoles(target), theirs = findJointRoles(motion.skeleton, motion.tips);
  if (ours.joint("left_hip") < 0)
    throw UsageError(
        "the character has no arms and legs that could be told by their names or their shape; "
        "only a motion with the names of its joints fits it");
  if (theirs.joint("left_hip") < 0)
    throw InputError(file,
                     "has no joints that could be told to be arms and legs, by name or by the shape of "
                     "the tree");
  std::fill(mapping.theirs.begin(), mapping.theirs.end(), -1);
  for (std::size_t role = 0; role < kJointRoles.size(); ++role)
    if (ours.joints[role] >= 0 && theirs.joints[role] >= 0)
      mapping.theirs[std::size_t(ours.joints[role])] = theirs.joints[role];
  mapping.by_shape = theirs.by_shape;
  return mapping;
}

struct Limb {
  int upper, middle, end;  // in one skeleton
};

std::vector<Limb> legsOf(const JointRoles& roles) {
  std::vector<Limb> legs;
  for (const std::string side : {"left_", "right_"})
    if (const Limb leg = {roles.joint(side + "hip"), roles.joint(side + "knee"), roles.joint(side + "foot")};
        leg.upper >= 0 && leg.middle >= 0 && leg.end >= 0)
      legs.push_back(leg);
  return legs;
}

double legLength(const Skeleton& skeleton, const std::vector<Limb>& legs) {
  const auto at = [&](int joint) -> const Vector3d& { return skeleton.joints[std::size_t(joint)].position; };
  double sum = 0;
  for (const Limb& leg : legs)
    sum += (at(leg.middle) - at(leg.upper)).norm() + (at(leg.end) - at(leg.middle)).norm();
  return legs.empty() ? 0 : sum / double(legs.size());
}

// The whole source at one moment.
struct SourcePose {
  std::vector<Quaterniond> globals;
  std::vector<Vector3d> positions;
};

SourcePose sourcePose(const BvhMotion& motion, const std::vector<const JointTrack*>& tracks,
                      std::size_t frame) {
  const std::vector<Joint>& joints = motion.skeleton.joints;
  SourcePose pose{std::vector<Quaterniond>(joints.size(), Quaterniond::Identity()),
                  std::vector<Vector3d>(joints.size())};
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const int parent = joints[j].parent;
    Vector3d place = joints[j].position;
    if (parent >= 0) place -= joints[std::size_t(parent)].position;
    Quaterniond local = Quaterniond::Identity();
    if (const JointTrack* track = tracks[j]) {
      if (!track->rotations.empty()) local = track->rotations[frame].cast<double>();
      if (!track->translations_m.empty()) place += track->translations_m[frame].cast<double>();
    }
    pose.positions[j] =
        parent < 0
            ? place
            : Vector3d(pose.positions[std::size_t(parent)] + pose.globals[std::size_t(parent)] * place);
    pose.globals[j] = parent < 0 ? local : pose.globals[std::size_t(parent)] * local;
  }
  return pose;
}

// The axis of the coordinates that is nearest, if it is near.
Vector3d nearestAxis(const Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const Vector3d nearest = Vector3d::Unit(axis) * (direction[axis] < 0 ? -1 : 1);
  return nearest.dot(direction) > 0.7 * direction.norm() ? nearest : direction.normalized();
}

// Columns: to the left, up, forwards, for one who stands along `up` and has that left.
Quaterniond standingFrame(const Vector3d& up, Vector3d left) {
  left -= left.dot(up) * up;
  if (!(left.norm() > 1e-9)) left = up.unitOrthogonal();
  left.normalize();
  Matrix3d frame;
  frame << left, up, left.cross(up);
  return Quaterniond(frame);
}

Vector3d leftOf(const JointRoles& roles, const std::vector<Vector3d>& at) {
  Vector3d left = Vector3d::Zero();
  for (const std::string joint : {"hip", "shoulder"}) {
    const int l = roles.joint("left_" + joint), r = roles.joint("right_" + joint);
    if (l >= 0 && r >= 0) left += (at[std::size_t(l)] - at[std::size_t(r)]).normalized();
  }
  return left;
}

std::vector<Vector3d> restPositions(const Skeleton& skeleton) {
  std::vector<Vector3d> at;
  for (const Joint& joint : skeleton.joints) at.push_back(joint.position);
  return at;
}

// Where their bone points in their rest pose: to the next joint that moves one of ours, as our bone does;
// else to its first child or to its tip. Zero: nowhere.
Vector3d theirBone(const BvhMotion& motion, const Mapping& mapping, const Skeleton& target, int ours) {
  const int theirs = mapping.theirs[std::size_t(ours)];
  const std::vector<Joint>& joints = motion.skeleton.joints;
  const Vector3d& from = joints[std::size_t(theirs)].position;
  for (std::size_t j = 0; j < target.joints.size(); ++j)
    if (target.joints[j].parent == ours && mapping.theirs[j] >= 0)
      return joints[std::size_t(mapping.theirs[j])].position - from;
  // Beyond hands and feet: a foot's own direction says nothing about how ours was drawn, the limb's does.
  const int parent = target.joints[std::size_t(ours)].parent;
  if (parent >= 0 && mapping.theirs[std::size_t(parent)] >= 0)
    return from - joints[std::size_t(mapping.theirs[std::size_t(parent)])].position;
  return Vector3d::Zero();
}

bool isLimb(const std::string& name) { return name.starts_with("left_") || name.starts_with("right_"); }

// A hand or a foot.
bool isLeaf(const Skeleton& skeleton, int joint) {
  return std::none_of(skeleton.joints.begin(), skeleton.joints.end(),
                      [&](const Joint& other) { return other.parent == joint; });
}

double lowestOf(const std::vector<Limb>& legs, const std::vector<Vector3d>& at, const Vector3d& up) {
  double lowest = 1e300;
  for (const Limb& leg : legs) lowest = std::min(lowest, at[std::size_t(leg.end)].dot(up));
  return lowest;
}

}  // namespace

RetargetedMotion retargetMotion(const BvhMotion& motion, const std::string& file, const Skeleton& target,
                                const FigureShape& shape) {
  const Mapping mapping = mapJoints(motion, file, target);
  const JointRoles our_roles = findJointRoles(target), roles = findJointRoles(motion.skeleton, motion.tips);
  RetargetedMotion result;
  result.match.by_shape = mapping.by_shape;
  std::set<int> used;
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    if (mapping.theirs[j] < 0) {
      result.match.ours_left.push_back(target.joints[j].name);
      continue;
    }
    used.insert(mapping.theirs[j]);
    result.match.joints.emplace_back(target.joints[j].name,
                                     motion.skeleton.joints[std::size_t(mapping.theirs[j])].name);
  }
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j)
    if (!used.count(int(j))) result.match.theirs_left.push_back(motion.skeleton.joints[j].name);

  // Their frames of reference: how they stand in the rest pose, and how they do at the first moment.
  std::vector<const JointTrack*> tracks(motion.skeleton.joints.size(), nullptr);
  std::vector<float> times;
  for (const JointTrack& track : motion.clip.tracks) {
    tracks[std::size_t(motion.skeleton.index(track.joint))] = &track;
    times = track.times_s.empty() ? track.translation_times_s : track.times_s;
  }
  std::vector<SourcePose> poses;
  for (std::size_t f = 0; f < times.size(); ++f) poses.push_back(sourcePose(motion, tracks, f));
  if (poses.empty()) throw InputError(file, "has no motion");
  const int their_root = mapping.theirs[0] >= 0 ? mapping.theirs[0] : 0;
  Quaterniond rest_frame = Quaterniond::Identity(), first_frame = Quaterniond::Identity();
  Vector3d up = Vector3d::UnitY();
  if (!mapping.same_names) {
    const std::vector<Vector3d> rest = restPositions(motion.skeleton);
    const int top = roles.joint("neck") >= 0 ? roles.joint("neck") : roles.joint("left_shoulder");
    up = nearestAxis(rest[std::size_t(top)] - rest[std::size_t(their_root)]);
    rest_frame = standingFrame(up, leftOf(roles, rest));
    first_frame = standingFrame(up, leftOf(roles, poses[0].positions));
  }

  // As a motion for the canonical pose, whose bones are theirs at rest.
  Clip clip;
  clip.name = motion.clip.name;
  clip.frame = mapping.same_names ? ClipFrame::kPicture : ClipFrame::kBody;
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    if (mapping.theirs[j] < 0) continue;
    JointTrack track;
    track.joint = target.joints[j].name;
    track.times_s = times;
    const bool points =
        mapping.same_names
            ? isLimb(track.joint)
            : std::any_of(kJointRoles.begin() + 4, kJointRoles.end(),
                          [&](std::string_view role) { return our_roles.joint(role) == int(j); });
    if (points && !(isLeaf(target, int(j)) && !mapping.same_names)) {
      const Vector3d bone = theirBone(motion, mapping, target, int(j));
      if (bone.norm() > 1e-9) track.bone = (rest_frame.conjugate() * bone.normalized()).cast<float>();
    }
    clip.tracks.push_back(std::move(track));
  }
  const auto motionOf = [&](const SourcePose& pose, int theirs) {
    return first_frame.conjugate() * pose.globals[std::size_t(theirs)] * rest_frame;
  };
  for (const SourcePose& pose : poses)
    for (JointTrack& track : clip.tracks) {
      const int joint = target.index(track.joint);
      // The nearest above that is moved too.
      int above = target.joints[std::size_t(joint)].parent;
      while (above >= 0 && mapping.theirs[std::size_t(above)] < 0)
        above = target.joints[std::size_t(above)].parent;
      Quaterniond local = motionOf(pose, mapping.theirs[std::size_t(joint)]);
      if (above >= 0) local = motionOf(pose, mapping.theirs[std::size_t(above)]).conjugate() * local;
      track.rotations.push_back(local.normalized().cast<float>());
    }

  // Ways on the ground, in heights of ours.
  const std::vector<Limb> legs = legsOf(roles), our_legs = legsOf(our_roles);
  const double length = legLength(motion.skeleton, legs);
  const double scale = length > 1e-9 ? legLength(target, our_legs) / length : 1;
  clip.root_times_s = times;
  for (const SourcePose& pose : poses) {
    const Vector3d way =
        pose.positions[std::size_t(their_root)] - poses[0].positions[std::size_t(their_root)];
    clip.root_translations.push_back((first_frame.conjugate() * way * scale / shape.height_m).cast<float>());
  }
  // Sampled as densely as the tool plays, with the target's own rest pose.
  RetargetOptions options;
  options.clear_of_head = false;
  options.shape = shape;
  options.thin_keys = false;
  result.clip = retargetToRest(clip, target, options);

  // Our feet are as far from the ground as theirs.
  if (!legs.empty() && !our_legs.empty()) {
    double ground = 1e300;
    for (const SourcePose& pose : poses) ground = std::min(ground, lowestOf(legs, pose.positions, up));
    const double our_ground = lowestOf(our_legs, restPositions(target), Vector3d::UnitY());
    for (std::size_t k = 0; k < result.clip.root_times_s.size(); ++k) {
      const float time_s = result.clip.root_times_s[k];
      const std::size_t after =
          std::size_t(std::lower_bound(times.begin(), times.end(), time_s) - times.begin());
      const std::size_t next = std::min(after, times.size() - 1), before = next > 0 ? next - 1 : 0;
      const double step = double(times[next]) - double(times[before]);
      const double t = step > 0 ? std::clamp((double(time_s) - double(times[before])) / step, 0.0, 1.0) : 0;
      const double air = scale * ((1 - t) * lowestOf(legs, poses[before].positions, up) +
                                  t * lowestOf(legs, poses[next].positions, up) - ground);
      const Pose pose = samplePose(result.clip, target, time_s);
      ModelPose ours;
      for (std::size_t j = 0; j < target.joints.size(); ++j) {
        const int parent = target.joints[j].parent;
        const Quaterniond local = pose.rotations[j].cast<double>();
        ours.globals.push_back(parent < 0 ? local : ours.globals[std::size_t(parent)] * local);
      }
      const double lowest = lowestOf(our_legs, jointPositions(target, ours), Vector3d::UnitY());
      result.clip.root_translations[k].y() = float((our_ground + air - lowest) / shape.height_m);
    }
  }
  return result;
}

}  // namespace skel
