#include "libskel/animation/follow_through.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_set>

#include "libskel/animation/bone_turn.h"
#include "libskel/animation/shortest_turn.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kStiffness = 1.5;  // of the spring: so many times what a pendulum of the length has
constexpr double kHeldUp = 6;       // the same of what does not hang down, but holds itself: wings, seats
constexpr double kDamping = 0.3;    // of the critical one
constexpr double kVivid = 1.6;      // so many times what moves it pushes it, as drawn cloth is
constexpr double kPlumb = 0.5;      // so far what hangs straight down keeps to the vertical
constexpr double kDeep = 0.5;       // of a swing, what is left of it to the viewer and away
constexpr int kSteps = 8;           // of the pendulum between two moments
constexpr int kLoops = 6;           // until a motion that repeats has swung in

Vector3d logarithm(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0 ? Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

Quaterniond exponential(const Vector3d& turn) {
  const double angle = turn.norm();
  return angle < 1e-12 ? Quaterniond::Identity() : Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

// Of even moments.
struct Moments {
  double step_s;
  bool repeats;  // the last is the first
  int count;

  int after(int k) const { return repeats ? (k + 1) % (count - 1) : std::min(k + 1, count - 1); }
  int before(int k) const { return repeats ? (k + count - 2) % (count - 1) : std::max(k - 1, 0); }
};

bool repeats(const std::vector<ModelPose>& poses, double size_m) {
  constexpr double kSame = 0.01;
  const ModelPose &first = poses.front(), &last = poses.back();
  if ((last.root_offset_m - first.root_offset_m).norm() > kSame * size_m) return false;
  for (std::size_t j = 0; j < first.globals.size(); ++j)
    if (first.globals[j].angularDistance(last.globals[j]) > kSame) return false;
  return true;
}

// What pushes the pendulum at each moment, rad/s², where it would rest, rad, and how it is pulled there,
// 1/s².
struct Drive {
  std::vector<Vector3d> push, rest;
  double stiff;
};

Drive driveOf(const Moments& moments, const std::vector<Vector3d>& pivot,
              const std::vector<Quaterniond>& carried, const Vector3d& bone, double length_m) {
  const double down = std::max(0.0, -bone.y());
  Drive drive{{}, {}, (down * kStiffness + (1 - down) * kHeldUp) * kGravity / length_m};
  const double step2 = moments.step_s * moments.step_s;
  for (int k = 0; k < moments.count; ++k) {
    const std::size_t now = std::size_t(k), next = std::size_t(moments.after(k)),
                      last = std::size_t(moments.before(k));
    const Vector3d along = carried[now] * bone;
    const Vector3d moved = (pivot[next] - 2 * pivot[now] + pivot[last]) / step2;
    const Vector3d turned = (logarithm(carried[next] * carried[now].conjugate()) -
                             logarithm(carried[now] * carried[last].conjugate())) /
                            step2;
    Vector3d push = -along.cross(moved) / length_m - turned;
    push -= push.dot(along) * along;
    drive.push.push_back(kVivid * push);
    drive.rest.push_back(kPlumb * down * logarithm(shortestTurn(along, bone)));
  }
  return drive;
}

// How the bone is turned against what carries it, at each moment.
std::vector<Vector3d> swing(const Moments& moments, const Drive& drive) {
  const double damp = 2 * kDamping * std::sqrt(drive.stiff);
  const double step = moments.step_s / kSteps;
  std::vector<Vector3d> turns(std::size_t(moments.count), Vector3d::Zero());
  Vector3d turn = drive.rest[0], speed = Vector3d::Zero();
  for (int loop = 0; loop < (moments.repeats ? kLoops : 1); ++loop)
    for (int k = 0; k < moments.count; ++k) {
      turns[std::size_t(k)] = turn;
      if (k + 1 == moments.count) break;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + .5) / kSteps;
        const auto between = [&](const std::vector<Vector3d>& of) -> Vector3d {
          return (1 - t) * of[std::size_t(k)] + t * of[std::size_t(k) + 1];
        };
        speed += step * (between(drive.push) - drive.stiff * (turn - between(drive.rest)) - damp * speed);
        turn += step * speed;
      }
    }
  return turns;
}

// Of each joint that hangs: to the next of its chain; the last is as long as the one before.
std::vector<double> hangingLengths(const std::vector<Joint>& joints) {
  std::vector<double> lengths(joints.size(), 0);
  for (std::size_t j = joints.size(); j-- > 1;) {
    if (!hangs(joints[j])) continue;
    const std::size_t parent = std::size_t(joints[j].parent);
    const double above = (joints[j].position - joints[parent].position).norm();
    if (lengths[j] == 0) lengths[j] = above;
    if (hangs(joints[parent])) lengths[parent] = above;
  }
  return lengths;
}

// No farther than cloth and bodies let it.
Vector3d bounded(Vector3d turn) {
  turn.x() *= kDeep;
  const double angle = turn.norm();
  return angle < 1e-9 ? turn
                      : Vector3d(turn * (kMostHanging_rad * std::tanh(angle / kMostHanging_rad) / angle));
}

}  // namespace

void followThrough(const Skeleton& skeleton, const Clip& clip, std::vector<ModelPose>& poses) {
  constexpr double kShortest = 0.05;  // bone, of the height of the root
  const std::vector<Joint>& joints = skeleton.joints;
  if (poses.size() < 3 || std::none_of(joints.begin(), joints.end(), hangs)) return;
  const double size_m = std::max(1e-6, std::abs(joints[0].position.y()));
  const Moments moments{
      (double(poses.back().time_s) - double(poses.front().time_s)) / double(poses.size() - 1),
      repeats(poses, size_m), int(poses.size())};
  if (!(moments.step_s > 0)) return;
  std::unordered_set<std::string_view> turned;
  for (const JointTrack& track : clip.tracks) turned.insert(track.joint);
  const std::vector<Vector3d> bones = restBones(skeleton);
  const std::vector<double> lengths = hangingLengths(joints);
  const std::vector<ModelPose> before = poses;
  std::vector<std::vector<Vector3d>> at;
  for (const ModelPose& pose : poses) at.push_back(jointPositions(skeleton, pose));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!hangs(joints[j]) || joints[j].parent < 0) continue;
    const std::size_t parent = std::size_t(joints[j].parent);
    std::vector<Vector3d> pivot;
    std::vector<Quaterniond> carried;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      std::vector<Quaterniond>& globals = poses[k].globals;
      globals[j] = globals[parent] * before[k].globals[parent].conjugate() * before[k].globals[j];
      at[k][j] = at[k][parent] + globals[parent] * (joints[j].position - joints[parent].position);
      pivot.push_back(at[k][j]);
      carried.push_back(globals[j]);
    }
    if (turned.count(joints[j].name)) continue;
    const double length_m = std::max(kShortest * size_m, lengths[j]);
    const std::vector<Vector3d> turns = swing(moments, driveOf(moments, pivot, carried, bones[j], length_m));
    for (std::size_t k = 0; k < poses.size(); ++k)
      poses[k].globals[j] = exponential(poses[k].share * bounded(turns[k])) * carried[k];
  }
}

}  // namespace skel
