#include "labeler/describe_step.h"

#include <algorithm>
#include <cstddef>

#include "libskel/core/text.h"

namespace skel {
namespace {

std::string strokesOf(const char* what, bool was_there, bool is_there) {
  return (was_there && is_there ? "a stroke of the " : "the ") + std::string(what);
}

std::string movedJoints(const DrawingState& before, const DrawingState& after,
                        const SkeletonTemplate& body_plan) {
  std::vector<std::string> moved;
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j)
    if (!body_plan.joints[j].derived && before.joints[j] != after.joints[j])
      moved.push_back(body_plan.joints[j].name);
  if (moved.size() != 1) return "the joints";
  std::replace(moved[0].begin(), moved[0].end(), '_', ' ');
  return "the " + moved[0];
}

std::string changedClasses(const DrawingState& before, const DrawingState& after) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(before.labels.size(), after.labels.size()); ++i)
    count += before.labels[i] != after.labels[i];
  return count == 1 ? "the class of a candidate" : "the classes of " + std::to_string(count) + " candidates";
}

}  // namespace

std::vector<Work> worksOf(const DrawingState& before, const DrawingState& after) {
  std::vector<Work> works;
  const bool same_mask = sameFile(before.mask.get(), after.mask.get());
  if (!same_mask) works.push_back(Work::kMask);
  if (before.layers != after.layers) works.push_back(Work::kLimbs);
  if (before.joints != after.joints || before.body_plan != after.body_plan) works.push_back(Work::kJoints);
  if (same_mask && before.labels != after.labels) works.push_back(Work::kClasses);
  return works;
}

std::string describeStep(const DrawingState& before, const DrawingState& after,
                         const SkeletonTemplate& body_plan) {
  std::vector<std::string> parts;
  for (const Work work : worksOf(before, after)) switch (work) {
      case Work::kMask:
        parts.push_back(strokesOf("mask", before.mask != nullptr, after.mask != nullptr));
        break;
      case Work::kLimbs:
        parts.push_back(strokesOf("limbs", before.layers != nullptr, after.layers != nullptr));
        break;
      case Work::kJoints:
        parts.push_back(before.body_plan == after.body_plan ? movedJoints(before, after, body_plan)
                                                            : "the joints of a " + after.body_plan);
        break;
      case Work::kClasses:
        parts.push_back(changedClasses(before, after));
    }
  return parts.empty() ? "what was taken up for this picture" : joined(parts);
}

}  // namespace skel
