#include "labeler/placed_joints.h"

#include <algorithm>

#include "labeler/figure.h"
#include "libskel/labels/annotated_image.h"

namespace skel {

const SkeletonTemplate* planOf(const LabelFile& labels, const BodyPlans& plans) {
  const std::vector<std::string> names = jointNames(labels.joints);
  if (const SkeletonTemplate* plan = planWith(names, plans)) return plan;
  return otherPlanWith(names, plans).empty() ? &plans.front() : nullptr;
}

NamedJoints namedJoints(const DrawingJoints& joints, const SkeletonTemplate& body_plan) {
  NamedJoints named;
  if (std::none_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.has_value(); }))
    return named;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j])
      named.emplace_back(body_plan.joints[j].name, joints[j]->image);
    else if (!body_plan.joints[j].derived)
      named.emplace_back(body_plan.joints[j].name, std::nullopt);
  }
  return named;
}

void takeJoints(const LabelFile& labels, const SkeletonTemplate& body_plan, DrawingJoints& joints) {
  for (const auto& [name, place] : labels.joints)
    if (const int j = body_plan.find(name); j >= 0 && place)
      joints[static_cast<size_t>(j)] = PlacedJoint{*place, 1, JointOrigin::kEdited};
  for (const std::string& name : labels.recognized)
    if (const int j = body_plan.find(name); j >= 0)
      joints[static_cast<size_t>(j)]->origin = JointOrigin::kRecognized;
}

void takeJoints(const Skeleton& skeleton, const SkeletonTemplate& body_plan, DrawingJoints& joints) {
  for (const Joint& joint : skeleton.joints)
    joints[static_cast<size_t>(body_plan.find(joint.name))] =
        PlacedJoint{joint.image, joint.confidence, joint.origin};
}

void placeJoints(const DrawingJoints& joints, const SkeletonTemplate& body_plan, Skeleton& skeleton) {
  for (Joint& joint : skeleton.joints) {
    const auto& place = joints[static_cast<size_t>(body_plan.find(joint.name))];
    if (!place) continue;
    joint.image = place->image;
    joint.confidence = place->confidence;
    joint.origin = place->origin;
  }
}

void deriveMidpoints(DrawingJoints& joints, const SkeletonTemplate& body_plan) {
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto& derived = body_plan.joints[j].derived;
    if (!derived || derived->rule != DerivationRule::kMidpoint) continue;
    if (joints[j] && joints[j]->origin == JointOrigin::kEdited) continue;
    const auto& a = joints[static_cast<size_t>(derived->from[0])];
    const auto& b = joints[static_cast<size_t>(derived->from[1])];
    if (a && b)
      joints[j] = PlacedJoint{(a->image + b->image) / 2, std::min(a->confidence, b->confidence),
                              JointOrigin::kDerived};
  }
}

int countFound(const DrawingJoints& joints) {
  return static_cast<int>(std::count_if(joints.begin(), joints.end(), [](const auto& joint) {
    return joint && joint->origin != JointOrigin::kCompleted;
  }));
}

Progress progressOf(const DrawingJoints& joints, const SkeletonTemplate& body_plan) {
  Progress progress;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j]) continue;
    const bool placed = joints[j]->origin == JointOrigin::kEdited;
    if (body_plan.joints[j].derived && !placed) continue;
    ++progress.parts;
    progress.done += placed;
  }
  return progress;
}

Progress jointsOf(const LabelFile& labels, const BodyPlans& plans) {
  Progress progress;
  const SkeletonTemplate* plan = planOf(labels, plans);
  if (!plan) return progress;
  for (const auto& [name, place] : labels.joints) {
    const int j = plan->find(name);
    if (j < 0 || !place || plan->joints[static_cast<size_t>(j)].derived) continue;
    ++progress.parts;
    progress.done += labels.isPlaced(name);
  }
  return progress;
}

int jointAt(const DrawingJoints& joints, const Eigen::Vector2d& image_px, double radius_px) {
  std::vector<std::optional<Eigen::Vector2d>> points;
  for (const auto& joint : joints)
    points.push_back(joint ? std::optional<Eigen::Vector2d>(joint->image) : std::nullopt);
  return nearestPoint(points, image_px, radius_px);
}

}  // namespace skel
