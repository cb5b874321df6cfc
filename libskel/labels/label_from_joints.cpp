#include "libskel/labels/label_from_joints.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/core/segment.h"

namespace skel {
namespace {

struct Place {
  std::optional<Eigen::Vector2d> at;  // grid px
  bool placed = true;                 // by a person
};

struct Segment {
  Eigen::Vector2d from, to;  // grid px
};

struct Bone : Segment {
  JointClass joint_class;
};

struct Bones {
  std::vector<Bone> placed;
  std::vector<Segment> found;    // that no person has placed
  std::vector<Segment> missing;  // straight between the joints that they would link; no longer than a point
                                 // where there is one joint alone
};

// A missing bone may bend, and goes on beyond the last joint that is known: so many times further away it may
// still be the nearest. On the 278 drawings of the labelled set, each without one joint after the other, this
// leaves 1 candidate in 1,500 with a wrong class (1 in 12 if missing bones are ignored), and 1 in 15 without
// one though it belongs to a bone that is known.
constexpr double kReachOfMissing = 2;
constexpr double kSamePlace_px = 1e-6;  // bones that end in one joint are equally near beyond it

double distanceTo(const Segment& segment, const Eigen::Vector2d& point) {
  return (nearestOnSegment(point, segment.from, segment.to) - point).norm();
}

double nearestOf(const std::vector<Segment>& segments, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) nearest = std::min(nearest, distanceTo(segment, point));
  return nearest;
}

// The last place of the figure on the way from `from` through `through`.
Eigen::Vector2d tipBeyond(const DistanceField& distance, const Eigen::Vector2d& from,
                          const Eigen::Vector2d& through) {
  const double length = (through - from).norm();
  if (length == 0) return through;
  const Eigen::Vector2d step = (through - from) / length;
  Eigen::Vector2d tip = through;
  for (Eigen::Vector2d next = tip + step;; next += step) {
    const auto x = std::lround(next.x()), y = std::lround(next.y());
    if (x < 0 || y < 0 || x >= distance.cols() || y >= distance.rows() || distance(y, x) <= 0) return tip;
    tip = next;
  }
}

std::vector<Place> placesOnGrid(const CandidateSet& candidates, const WorkingGrid& grid,
                                const NamedJoints& joints, const SkeletonTemplate& body_plan,
                                const std::vector<std::string>& recognized) {
  std::vector<Place> places(body_plan.joints.size());
  for (const auto& [name, place] : joints)
    if (const int j = body_plan.find(name); j >= 0 && place)
      places[static_cast<std::size_t>(j)] = {
          grid.gridFromImage(*place),
          std::find(recognized.begin(), recognized.end(), name) == recognized.end()};
  // A derived joint may come from another one that stands after it: as many passes as there may be links.
  for (std::size_t pass = 0; pass < places.size(); ++pass)
    for (std::size_t j = 0; j < places.size(); ++j) {
      const auto& derived = body_plan.joints[j].derived;
      if (!derived || (places[j].at && places[j].placed)) continue;
      const Place& a = places[static_cast<std::size_t>(derived->from[0])];
      const Place& b = places[static_cast<std::size_t>(derived->from[1])];
      if (!a.at || !b.at) continue;
      places[j].placed = a.placed && b.placed;
      if (places[j].at) continue;
      places[j].at = derived->rule == DerivationRule::kMidpoint
                         ? Eigen::Vector2d((*a.at + *b.at) / 2)
                         : tipBeyond(candidates.distance, *a.at, *b.at);
    }
  return places;
}

// Of joints without a place those that hang together are one gap.
std::vector<Segment> missingBones(const std::vector<Place>& places, const SkeletonTemplate& body_plan) {
  std::vector<std::size_t> gap(places.size());  // the first joint of it; of others the joint itself
  for (std::size_t j = 0; j < places.size(); ++j) {
    const int parent = body_plan.joints[j].parent;
    const bool below_gap = parent >= 0 && !places[static_cast<std::size_t>(parent)].at;
    gap[j] = below_gap ? gap[static_cast<std::size_t>(parent)] : j;
  }
  std::vector<Segment> missing;
  for (std::size_t first = 0; first < places.size(); ++first) {
    if (places[first].at || gap[first] != first) continue;
    std::vector<Eigen::Vector2d> ends;
    if (const int parent = body_plan.joints[first].parent; parent >= 0)
      ends.push_back(*places[static_cast<std::size_t>(parent)].at);
    for (std::size_t j = 0; j < places.size(); ++j)
      if (places[j].at && gap[j] == first) ends.push_back(*places[j].at);
    for (std::size_t a = 0; a < ends.size(); ++a)
      for (std::size_t b = a; b < ends.size(); ++b) missing.push_back({ends[a], ends[b]});
  }
  return missing;
}

Bones bonesOf(const std::vector<Place>& places, const SkeletonTemplate& body_plan) {
  Bones bones;
  bones.missing = missingBones(places, body_plan);
  for (std::size_t j = 0; j < places.size(); ++j) {
    const TemplateJoint& joint = body_plan.joints[j];
    if (joint.parent < 0 || !joint.bone_class) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    if (!places[j].at || !places[parent].at) continue;
    const Eigen::Vector2d from = *places[parent].at, to = *places[j].at;
    if (!places[j].placed || !places[parent].placed) {
      bones.found.push_back({from, to});
      continue;
    }
    const Eigen::Vector2d middle = from + joint.class_from * (to - from);
    bones.placed.push_back({{middle, to}, *joint.bone_class});
    const std::optional<JointClass> before = body_plan.joints[parent].bone_class;
    if (joint.class_from > 0 && before) bones.placed.push_back({{from, middle}, *before});
  }
  return bones;
}

}  // namespace

std::vector<std::optional<JointClass>> labelFromJoints(const CandidateSet& candidates,
                                                       const WorkingGrid& grid, const NamedJoints& joints,
                                                       const SkeletonTemplate& body_plan,
                                                       const std::vector<std::string>& recognized) {
  const Bones bones = bonesOf(placesOnGrid(candidates, grid, joints, body_plan, recognized), body_plan);
  std::vector<std::optional<JointClass>> labels;
  for (const JointCandidate& candidate : candidates.maxima) {
    const Eigen::Vector2d point(candidate.x, candidate.y);
    double nearest = std::numeric_limits<double>::infinity();
    auto& label = labels.emplace_back();
    for (const Bone& bone : bones.placed)
      if (const double distance = distanceTo(bone, point); distance < nearest)
        nearest = distance, label = bone.joint_class;
    if (nearestOf(bones.found, point) < nearest + kSamePlace_px ||
        nearestOf(bones.missing, point) < kReachOfMissing * nearest + kSamePlace_px)
      label.reset();
  }
  return labels;
}

}  // namespace skel
