#include "libskel/animation/retarget_motion.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "libskel/animation/arm_abilities.h"
#include "libskel/animation/bone_turn.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/animation/plant_feet.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/animation/shortest_turn.h"
#include "libskel/core/error.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

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

// A file's motion with nothing of its rest pose: how the figure stands at each moment.
struct Source {
  const BvhMotion& motion;
  std::vector<float> times_s;
  std::vector<SourcePose> poses;
  JointRoles roles;                      // as the first moment tells them
  Vector3d up = Vector3d::UnitY();       // the axis along which it stands on the whole
  std::vector<Quaterniond> stands = {};  // where it stands to be as drawn, one a moment

  Vector3d at(const SourcePose& pose, std::string_view role) const {
    return pose.positions[std::size_t(roles.joint(role))];
  }
  bool has(std::string_view role) const { return roles.joint(role) >= 0; }
  Vector3d shoulders(const SourcePose& pose) const {
    return (at(pose, "left_shoulder") + at(pose, "right_shoulder")) / 2;
  }
  Vector3d hips(const SourcePose& pose) const { return (at(pose, "left_hip") + at(pose, "right_hip")) / 2; }
  // From the hips to the shoulders: necks differ in where they begin.
  Vector3d trunk(const SourcePose& pose) const { return shoulders(pose) - hips(pose); }
};

// The axis of the coordinates that is nearest, if it is near.
Vector3d nearestAxis(const Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const Vector3d nearest = Vector3d::Unit(axis) * (direction[axis] < 0 ? -1 : 1);
  return nearest.dot(direction) > 0.7 * direction.norm() ? nearest : direction.normalized();
}

// Columns: to the left, up, forwards, for one who stands along `up` and has that left.
Quaterniond standingFrame(Vector3d up, Vector3d left) {
  up.normalize();
  left -= left.dot(up) * up;
  if (!(left.norm() > 1e-9)) left = up.unitOrthogonal();
  left.normalize();
  Matrix3d frame;
  frame << left, up, left.cross(up);
  return Quaterniond(frame);
}

// The mean way from the right to the left of hips and shoulders.
Vector3d leftOf(const Source& source, const SourcePose& pose) {
  return ((source.at(pose, "left_hip") - source.at(pose, "right_hip")).normalized() +
          (source.at(pose, "left_shoulder") - source.at(pose, "right_shoulder")).normalized()) /
         2;
}

// How it stands at each moment; where it lies on its side, as it did before.
std::vector<Quaterniond> headings(const Source& source) {
  constexpr double kLies = 0.3;
  std::vector<Quaterniond> result;
  for (const SourcePose& pose : source.poses) {
    const Vector3d left = leftOf(source, pose);
    const bool lies = (left - left.dot(source.up) * source.up).norm() < kLies;
    result.push_back(lies && !result.empty() ? result.back() : standingFrame(source.up, left));
  }
  return result;
}

Source readSource(const BvhMotion& motion, const std::string& file, bool keeps_facing) {
  Source source{motion, {}, {}, {}};
  std::vector<const JointTrack*> tracks(motion.skeleton.joints.size(), nullptr);
  for (const JointTrack& track : motion.clip.tracks) {
    tracks[std::size_t(motion.skeleton.index(track.joint))] = &track;
    source.times_s = track.times_s.empty() ? track.translation_times_s : track.times_s;
  }
  for (std::size_t f = 0; f < source.times_s.size(); ++f)
    source.poses.push_back(sourcePose(motion, tracks, f));
  if (source.poses.empty()) throw InputError(file, "has no motion");

  const SourcePose& start = source.poses[0];
  Skeleton as_it_begins = motion.skeleton;
  std::vector<Vector3d> tips = motion.tips;
  for (std::size_t j = 0; j < tips.size(); ++j) {
    as_it_begins.joints[j].position = start.positions[j];
    tips[j] = start.globals[j] * tips[j];
  }
  source.roles = findJointRoles(as_it_begins, tips);
  if (!source.has("left_hip")) return source;
  Vector3d standing = Vector3d::Zero();
  for (const SourcePose& pose : source.poses)
    standing += source.shoulders(pose) - (source.at(pose, "left_foot") + source.at(pose, "right_foot")) / 2;
  source.up = nearestAxis(standing);
  source.stands = keeps_facing ? headings(source)
                               : std::vector<Quaterniond>(source.poses.size(),
                                                          standingFrame(source.up, leftOf(source, start)));
  return source;
}

// Hanging joints need not be there: they follow.
bool hasAllNames(const Skeleton& theirs, const Skeleton& target) {
  return std::all_of(target.joints.begin(), target.joints.end(),
                     [&](const Joint& joint) { return hangs(joint) || theirs.find(joint.name) >= 0; });
}

// Which joint of theirs moves each of ours, -1: none; and whether all names are ours.
struct Mapping {
  std::vector<int> theirs;
  bool same_names = false;
};

Mapping mapJoints(const Source& source, const std::string& file, const Skeleton& target) {
  Mapping mapping;
  for (const Joint& joint : target.joints) mapping.theirs.push_back(source.motion.skeleton.find(joint.name));
  mapping.same_names = hasAllNames(source.motion.skeleton, target);
  if (mapping.same_names) return mapping;
  const JointRoles ours = findJointRoles(target);
  if (ours.joint("left_hip") < 0)
    throw UsageError(
        "the character has no arms and legs that could be told by their names or their shape; "
        "only a motion with the names of its joints fits it");
  if (!source.has("left_hip"))
    throw InputError(file,
                     "has no joints that could be told to be arms and legs, by name or by the shape of "
                     "the tree");
  std::fill(mapping.theirs.begin(), mapping.theirs.end(), -1);
  for (std::size_t role = 0; role < kJointRoles.size(); ++role)
    if (ours.joints[role] >= 0 && source.roles.joints[role] >= 0)
      mapping.theirs[std::size_t(ours.joints[role])] = source.roles.joints[role];
  return mapping;
}

JointMatch matchOf(const Mapping& mapping, const Source& source, const Skeleton& target) {
  JointMatch match;
  match.by_shape = !mapping.same_names && source.roles.by_shape;
  const std::vector<Joint>& joints = source.motion.skeleton.joints;
  std::set<int> used;
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    if (hangs(target.joints[j])) continue;
    if (mapping.theirs[j] < 0) {
      match.ours_left.push_back(target.joints[j].name);
      continue;
    }
    used.insert(mapping.theirs[j]);
    match.joints.emplace_back(target.joints[j].name, joints[std::size_t(mapping.theirs[j])].name);
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (const int same = target.find(joints[j].name);
        !used.count(int(j)) && !(same >= 0 && hangs(target.joints[std::size_t(same)])))
      match.theirs_left.push_back(joints[j].name);
  return match;
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

double legLength(const std::vector<Vector3d>& at, const std::vector<Limb>& legs) {
  double sum = 0;
  for (const Limb& leg : legs)
    sum += (at[std::size_t(leg.middle)] - at[std::size_t(leg.upper)]).norm() +
           (at[std::size_t(leg.end)] - at[std::size_t(leg.middle)]).norm();
  return legs.empty() ? 0 : sum / double(legs.size());
}

std::vector<Vector3d> restPositions(const Skeleton& skeleton) {
  std::vector<Vector3d> at;
  for (const Joint& joint : skeleton.joints) at.push_back(joint.position);
  return at;
}

// The rotation that all of them are nearest to: the largest eigenvector of their outer products, which does
// not ask for their signs (F. Markley et al., "Averaging quaternions", 2007).
Quaterniond mean(const std::vector<Quaterniond>& rotations) {
  Matrix4d sum = Matrix4d::Zero();
  for (const Quaterniond& q : rotations) sum += q.coeffs() * q.coeffs().transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix4d> solver(sum);
  return Quaterniond(Eigen::Vector4d(solver.eigenvectors().col(3)));
}

// Without what turns about `axis`.
Quaterniond withoutTwist(const Quaterniond& q, const Vector3d& axis) {
  Quaterniond twist(q.w(), 0, 0, 0);
  twist.vec() = q.vec().dot(axis) * axis;
  if (!(twist.norm() > 1e-6)) return q;
  return q * twist.normalized().conjugate();
}

const Vector3d kDown = -Vector3d::UnitY();

// Turns of the canonical figure (upright, arms and legs straight down, towards +z) to the model frame, one a
// role and moment: its bones point where theirs do. About its own axis a bone of a limb turns no more than it
// must, for a drawn limb shows nothing of that.
using RoleTurns = std::array<std::vector<Quaterniond>, kJointRoles.size()>;

// What ends a limb, or the trunk, and where it looks, its joint's place does not tell: on the whole it is
// held as what carries it.
std::vector<Quaterniond> turnsOfEnd(const Source& source, std::string_view role,
                                    const std::vector<Quaterniond>& carriers, bool twists) {
  if (!source.has(role)) return carriers;
  std::vector<Quaterniond> locals;
  for (std::size_t f = 0; f < carriers.size(); ++f)
    locals.push_back(carriers[f].conjugate() * source.stands[f].conjugate() *
                     source.poses[f].globals[std::size_t(source.roles.joint(role))]);
  const Quaterniond rest = mean(locals).conjugate();
  std::vector<Quaterniond> turns;
  for (std::size_t f = 0; f < carriers.size(); ++f) {
    const Quaterniond local = locals[f] * rest;
    turns.push_back(carriers[f] * (twists ? local : withoutTwist(local, kDown)));
  }
  return turns;
}

RoleTurns roleTurns(const Source& source) {
  RoleTurns turns;
  const auto of = [&](std::string_view role) -> std::vector<Quaterniond>& { return turns[roleIndex(role)]; };
  for (std::size_t f = 0; f < source.poses.size(); ++f) {
    const SourcePose& pose = source.poses[f];
    const Quaterniond to_ours = source.stands[f].conjugate();
    const Vector3d trunk = source.trunk(pose);
    of("pelvis").push_back(to_ours *
                           standingFrame(trunk, source.at(pose, "left_hip") - source.at(pose, "right_hip")));
    of("body").push_back(
        to_ours * standingFrame(trunk, source.at(pose, "left_shoulder") - source.at(pose, "right_shoulder")));
  }
  of("neck") = of("body");
  of("head") = turnsOfEnd(source, "head", of("body"), true);
  struct LimbRoles {
    std::string_view trunk, upper, middle, end;
    Vector3d eased;  // an upper bone hardly ever points against it
  };
  for (const std::string side : {"left_", "right_"}) {
    const double out = side == "left_" ? 1 : -1;
    const std::string arm[3] = {side + "shoulder", side + "elbow", side + "hand"},
                      leg[3] = {side + "hip", side + "knee", side + "foot"};
    for (const LimbRoles& limb :
         {LimbRoles{"body", arm[0], arm[1], arm[2], Vector3d(out, -1, 0).normalized()},
          LimbRoles{"pelvis", leg[0], leg[1], leg[2], kDown}}) {
      const Quaterniond ease = shortestTurn(kDown, limb.eased);
      const bool ends = source.has(limb.end);
      for (std::size_t f = 0; f < source.poses.size(); ++f) {
        const SourcePose& pose = source.poses[f];
        const Quaterniond to_ours = source.stands[f].conjugate();
        const Quaterniond trunk = of(limb.trunk)[f];
        const Vector3d upper =
            (to_ours * (source.at(pose, limb.middle) - source.at(pose, limb.upper))).normalized();
        const std::size_t middle = std::size_t(source.roles.joint(limb.middle));
        const Vector3d along = ends ? Vector3d(source.at(pose, limb.end) - pose.positions[middle])
                                    : Vector3d(pose.globals[middle] * source.motion.tips[middle]);
        Quaterniond turn = trunk * shortestTurn(limb.eased, trunk.conjugate() * upper) * ease;
        of(limb.upper).push_back(turn);
        if (along.norm() > 1e-9) turn = shortestTurn(upper, to_ours * along) * turn;
        of(limb.middle).push_back(turn);
      }
      of(limb.end) = turnsOfEnd(source, limb.end, of(limb.middle), false);
    }
  }
  return turns;
}

// Where their bone points in their rest pose, which is our drawn one: to the next joint that moves one of
// ours, as our bone does; of a hand or a foot, as the bone before. Zero: nowhere.
Vector3d restBoneOf(const BvhMotion& motion, const Mapping& mapping, const Skeleton& target, int ours) {
  const std::vector<Joint>& joints = motion.skeleton.joints;
  const Vector3d& from = joints[std::size_t(mapping.theirs[std::size_t(ours)])].position;
  for (std::size_t j = 0; j < target.joints.size(); ++j)
    if (target.joints[j].parent == ours && !hangs(target.joints[j]))
      return joints[std::size_t(mapping.theirs[j])].position - from;
  const int parent = target.joints[std::size_t(ours)].parent;
  return parent < 0 ? Vector3d::Zero()
                    : Vector3d(from - joints[std::size_t(mapping.theirs[std::size_t(parent)])].position);
}

bool isLimb(const std::string& name) { return name.starts_with("left_") || name.starts_with("right_"); }

// From each joint's parent to the joint, of those joints of `like` that `skeleton` has and that stay in the
// rest pose; zero for others.
std::vector<Vector3d> offsetsOf(const Skeleton& skeleton, const Skeleton& like) {
  std::vector<Vector3d> offsets;
  for (const Joint& joint : like.joints) {
    const int own = hangs(joint) ? -1 : skeleton.find(joint.name);
    const int parent = own < 0 ? -1 : skeleton.joints[std::size_t(own)].parent;
    offsets.push_back(parent < 0 ? Vector3d::Zero()
                                 : Vector3d(skeleton.joints[std::size_t(own)].position -
                                            skeleton.joints[std::size_t(parent)].position));
  }
  return offsets;
}

// The turn of the file's axes that brings the rest pose nearest to the target's: none, but for programs whose
// up is z and that look along y, as Blender does, or against it. No other: a figure that leans or squats may
// lie nearer to one that stands when either is turned by a quarter.
Quaterniond turnOfAxes(const Skeleton& theirs, const Skeleton& target) {
  const std::vector<Vector3d> from = offsetsOf(theirs, target), to = offsetsOf(target, target);
  const Quaterniond up(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX()));
  const Quaterniond around(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitY()));
  Quaterniond best = Quaterniond::Identity();
  double best_sum = -1e300;
  for (const Quaterniond& turn : {Quaterniond::Identity(), up, Quaterniond(around * up)}) {
    double sum = 0;  // of cosines; the file's own axes where others are no better
    for (std::size_t j = 0; j < from.size(); ++j)
      if (from[j].norm() > 1e-9 && to[j].norm() > 1e-9)
        sum += (turn * from[j]).normalized().dot(to[j].normalized());
    if (sum > best_sum + 1e-6) best_sum = sum, best = turn;
  }
  return best;
}

BvhMotion turnedBy(const Quaterniond& turn, BvhMotion motion) {
  for (Joint& joint : motion.skeleton.joints) joint.position = turn * joint.position;
  for (Vector3d& tip : motion.tips) tip = turn * tip;
  for (JointTrack& track : motion.clip.tracks) {
    for (Eigen::Quaternionf& rotation : track.rotations)
      rotation = (turn * rotation.cast<double>() * turn.conjugate()).cast<float>();
    for (Eigen::Vector3f& place : track.translations_m) place = (turn * place.cast<double>()).cast<float>();
  }
  return motion;
}

// What a length of theirs is of ours, m, if their rest pose is ours in other lengths: a motion written for
// this very character.
std::optional<double> scaleOfOwn(const Skeleton& theirs, const Skeleton& target, double height_m) {
  constexpr double kSame = 2e-3;  // of the height: numbers in text, through other programs
  const std::vector<Vector3d> from = offsetsOf(theirs, target), to = offsetsOf(target, target);
  double ours = 0, all = 0;
  for (std::size_t j = 0; j < from.size(); ++j) ours += from[j].dot(to[j]), all += from[j].squaredNorm();
  if (!(all > 0) || !(ours > 0)) return std::nullopt;
  const double scale = ours / all;
  for (std::size_t j = 0; j < from.size(); ++j)
    if (!((scale * from[j] - to[j]).norm() <= kSame * height_m)) return std::nullopt;
  return scale;
}

// A motion of this very character, as it is.
Clip ownClip(const Source& source, const Skeleton& target, double scale, double height_m) {
  const Skeleton& theirs = source.motion.skeleton;
  Clip clip;
  for (const Joint& joint : target.joints)
    for (const JointTrack& track : source.motion.clip.tracks)
      if (track.joint == joint.name) {
        JointTrack& own = clip.tracks.emplace_back(track);
        if (joint.parent < 0) own.translations_m.clear(), own.translation_times_s.clear();
        for (Eigen::Vector3f& place : own.translations_m) place *= float(scale);
      }
  const std::size_t root = std::size_t(theirs.index(target.joints[0].name));
  clip.root_times_s = source.times_s;
  for (const SourcePose& pose : source.poses)
    clip.root_translations.push_back(
        ((scale * pose.positions[root] - target.joints[0].position) / height_m).cast<float>());
  return clip;
}

// A motion for our own joints, of another character: its turns are ours.
void takeTurns(const Source& source, const Mapping& mapping, const Skeleton& target, Clip& clip) {
  clip.frame = ClipFrame::kPicture;
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    if (hangs(target.joints[j])) continue;
    JointTrack track;
    track.joint = target.joints[j].name;
    track.times_s = source.times_s;
    if (isLimb(track.joint)) {
      const Vector3d bone = restBoneOf(source.motion, mapping, target, int(j));
      if (bone.norm() > 1e-9) track.bone = bone.normalized().cast<float>();
    }
    const int parent = target.joints[j].parent;
    for (const SourcePose& pose : source.poses) {
      Quaterniond local = pose.globals[std::size_t(mapping.theirs[j])];
      if (parent >= 0)
        local = pose.globals[std::size_t(mapping.theirs[std::size_t(parent)])].conjugate() * local;
      track.rotations.push_back(local.normalized().cast<float>());
    }
    clip.tracks.push_back(std::move(track));
  }
}

// A motion for joints of other names, other lengths and another rest pose: where bones point is ours. A
// person who leans goes on leaning, one who lies or stands on his hands stands up, as for skel's own clips.
void takeDirections(const Source& source, const Mapping& mapping, const Skeleton& target, Clip& clip) {
  clip.frame = ClipFrame::kBody;
  const RoleTurns turns = roleTurns(source);
  const JointRoles ours = findJointRoles(target);
  std::vector<int> role_of(target.joints.size(), -1);
  for (std::size_t role = 0; role < kJointRoles.size(); ++role)
    if (ours.joints[role] >= 0) role_of[std::size_t(ours.joints[role])] = int(role);
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    if (mapping.theirs[j] < 0) continue;
    const std::size_t role = std::size_t(role_of[j]);
    JointTrack track;
    track.joint = target.joints[j].name;
    track.times_s = source.times_s;
    if (!kJointRoles[role].ends_with("hand") && !kJointRoles[role].ends_with("foot") &&
        isLimb(std::string(kJointRoles[role])))
      track.bone = kDown.cast<float>();
    if (target.template_name == "biped" &&
        std::find(kTrunkJoints.begin(), kTrunkJoints.end(), kJointRoles[role]) != kTrunkJoints.end())
      track.bone = Eigen::Vector3f::UnitY(), track.slack_rad = kTrunkSlack_rad;
    // The nearest above that is moved too.
    int above = target.joints[j].parent;
    while (above >= 0 && mapping.theirs[std::size_t(above)] < 0)
      above = target.joints[std::size_t(above)].parent;
    for (std::size_t f = 0; f < source.poses.size(); ++f) {
      Quaterniond local = turns[role][f];
      if (above >= 0) local = turns[std::size_t(role_of[std::size_t(above)])][f].conjugate() * local;
      track.rotations.push_back(local.normalized().cast<float>());
    }
    clip.tracks.push_back(std::move(track));
  }
}

// How high their lowest foot is above the ground, toes included, one a moment. The ground is where it is
// lowest, but for a few moments of what was recorded: such feet sink into it now and then.
std::vector<double> heightsAboveGround(const Source& source, const std::vector<Limb>& legs, bool recorded) {
  const std::vector<Joint>& joints = source.motion.skeleton.joints;
  std::vector<char> foot(joints.size(), 0);
  for (const Limb& leg : legs) foot[std::size_t(leg.end)] = 1;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].parent >= 0 && foot[std::size_t(joints[j].parent)]) foot[j] = 1;
  std::vector<double> heights;
  for (const SourcePose& pose : source.poses) {
    double lowest = 1e300;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (foot[j])
        lowest = std::min({lowest, pose.positions[j].dot(source.up),
                           (pose.positions[j] + pose.globals[j] * source.motion.tips[j]).dot(source.up)});
    heights.push_back(lowest);
  }
  std::vector<double> sorted = heights;
  const auto few = sorted.begin() + std::ptrdiff_t(recorded ? sorted.size() / 20 : 0);
  std::nth_element(sorted.begin(), few, sorted.end());
  const double ground = *few;
  for (double& height : heights) height = std::max(0.0, height - ground);
  return heights;
}

double lowestSole(const std::vector<Limb>& legs, const FigureShape& shape, const std::vector<Vector3d>& at,
                  const std::vector<Quaterniond>& turns) {
  double lowest = 1e300;
  for (const Limb& leg : legs)
    lowest = std::min(lowest,
                      at[std::size_t(leg.end)].y() + soleBelow(shape, leg.end, turns[std::size_t(leg.end)]));
  return lowest;
}

// Our lowest foot is as far from the ground as theirs.
void standOnGround(const Source& source, bool recorded, const Skeleton& target, const FigureShape& shape,
                   double scale, Clip& clip) {
  const std::vector<Limb> legs = legsOf(source.roles), our_legs = legsOf(findJointRoles(target));
  if (legs.empty() || our_legs.empty()) return;
  const std::vector<double> heights = heightsAboveGround(source, legs, recorded);
  const std::vector<float>& times = source.times_s;
  double ground = lowestSole(our_legs, shape, restPositions(target),
                             std::vector<Quaterniond>(target.joints.size(), Quaterniond::Identity()));
  // Who stood on his hands stands on what they were on.
  if (recorded && ground > target.joints[0].position.y()) ground = 0;
  const ClipSampler sampler(clip, target);
  for (std::size_t k = 0; k < clip.root_times_s.size(); ++k) {
    const float time_s = clip.root_times_s[k];
    const std::size_t after =
        std::size_t(std::lower_bound(times.begin(), times.end(), time_s) - times.begin());
    const std::size_t next = std::min(after, times.size() - 1), before = next > 0 ? next - 1 : 0;
    const double step = double(times[next]) - double(times[before]);
    const double t = step > 0 ? std::clamp((double(time_s) - double(times[before])) / step, 0.0, 1.0) : 0;
    const double air = scale * ((1 - t) * heights[before] + t * heights[next]);
    const Pose pose = sampler.at(time_s);
    ModelPose ours;
    for (std::size_t j = 0; j < target.joints.size(); ++j) {
      const int parent = target.joints[j].parent;
      const Quaterniond local = pose.rotations[j].cast<double>();
      ours.globals.push_back(parent < 0 ? local : ours.globals[std::size_t(parent)] * local);
    }
    const double lowest = lowestSole(our_legs, shape, jointPositions(target, ours), ours.globals);
    clip.root_translations[k].y() = float((ground + air - lowest) / shape.height_m);
  }
}

bool isFinite(const Clip& clip) {
  const auto isTurn = [](const Eigen::Quaternionf& turn) { return turn.coeffs().allFinite(); };
  const auto isPlace = [](const Eigen::Vector3f& place) { return place.allFinite(); };
  return std::all_of(clip.root_translations.begin(), clip.root_translations.end(), isPlace) &&
         std::all_of(clip.tracks.begin(), clip.tracks.end(), [&](const JointTrack& track) {
           return std::all_of(track.rotations.begin(), track.rotations.end(), isTurn) &&
                  std::all_of(track.translations_m.begin(), track.translations_m.end(), isPlace);
         });
}

}  // namespace

RetargetedMotion retargetMotion(const BvhMotion& given, const std::string& file, const Skeleton& target,
                                const FigureShape& shape, const MotionOptions& asked) {
  std::optional<BvhMotion> turned;
  if (hasAllNames(given.skeleton, target)) turned = turnedBy(turnOfAxes(given.skeleton, target), given);
  const BvhMotion& motion = turned ? *turned : given;
  const Source source = readSource(motion, file, asked.keeps_facing);
  const Mapping mapping = mapJoints(source, file, target);
  RetargetedMotion result;
  result.match = matchOf(mapping, source, target);
  if (mapping.same_names)
    if (const auto own = scaleOfOwn(motion.skeleton, target, shape.height_m)) {
      result.clip = ownClip(source, target, *own, shape.height_m);
      result.clip.name = motion.clip.name;
      return result;
    }

  Clip clip;
  clip.name = motion.clip.name;
  if (mapping.same_names)
    takeTurns(source, mapping, target, clip);
  else
    takeDirections(source, mapping, target, clip);

  // Ways on the ground, in heights of ours.
  const double length = legLength(source.poses[0].positions, legsOf(source.roles)),
               our_length = legLength(restPositions(target), legsOf(findJointRoles(target)));
  const double scale = length > 1e-9 && our_length > 0 ? our_length / length : 1;
  const Quaterniond to_ours = mapping.same_names ? Quaterniond::Identity() : source.stands[0].conjugate();
  const std::size_t root = mapping.theirs[0] >= 0 ? std::size_t(mapping.theirs[0]) : 0;
  clip.root_times_s = source.times_s;
  for (const SourcePose& pose : source.poses) {
    const Vector3d way = pose.positions[root] - source.poses[0].positions[root];
    clip.root_translations.push_back((to_ours * way * scale / shape.height_m).cast<float>());
  }
  const auto checkFinite = [&](const Clip& made) {
    if (!isFinite(made)) throw InputError(file, "has bones without length, which point nowhere");
  };
  checkFinite(clip);
  // Sampled as densely as the tool plays, with the target's own rest pose.
  RetargetOptions options;
  options.clear_of_head = false;
  options.shape = shape;
  options.into_picture = mapping.same_names ? 0 : asked.into_picture;
  options.aslant = true;
  options.thin_keys = false;
  result.arms_that_stay = armsThatStay({&clip, 1}, target, shape);
  result.clip = retargetToRest(clip, target, options);
  standOnGround(source, !mapping.same_names, target, shape, scale, result.clip);
  checkFinite(result.clip);
  return result;
}

}  // namespace skel
