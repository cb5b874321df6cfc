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

struct Bone {
  Eigen::Vector2d from, to;  // grid px
  JointClass joint_class;
  bool placed;
};

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

std::vector<Bone> bonesOf(const std::vector<Place>& places, const SkeletonTemplate& body_plan) {
  std::vector<Bone> bones;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const TemplateJoint& joint = body_plan.joints[j];
    if (joint.parent < 0 || !joint.bone_class) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    if (!places[j].at || !places[parent].at) continue;
    const Eigen::Vector2d from = *places[parent].at, to = *places[j].at;
    const bool placed = places[j].placed && places[parent].placed;
    const Eigen::Vector2d middle = from + joint.class_from * (to - from);
    bones.push_back({middle, to, *joint.bone_class, placed});
    const std::optional<JointClass> before = body_plan.joints[parent].bone_class;
    if (joint.class_from > 0 && before) bones.push_back({from, middle, *before, placed});
  }
  return bones;
}

}  // namespace

std::vector<std::optional<JointClass>> labelFromJoints(const CandidateSet& candidates,
                                                       const WorkingGrid& grid, const NamedJoints& joints,
                                                       const SkeletonTemplate& body_plan,
                                                       const std::vector<std::string>& recognized) {
  const std::vector<Bone> bones =
      bonesOf(placesOnGrid(candidates, grid, joints, body_plan, recognized), body_plan);
  std::vector<std::optional<JointClass>> labels;
  for (const JointCandidate& candidate : candidates.maxima) {
    const Eigen::Vector2d point(candidate.x, candidate.y);
    double nearest = std::numeric_limits<double>::infinity();
    auto& label = labels.emplace_back();
    for (const Bone& bone : bones)
      if (const double distance = (nearestOnSegment(point, bone.from, bone.to) - point).squaredNorm();
          distance < nearest) {
        nearest = distance;
        label = bone.placed ? std::optional(bone.joint_class) : std::nullopt;
      }
  }
  return labels;
}

}  // namespace skel
