#include "libskel/skeleton/body_plans.h"

#include <algorithm>

namespace skel {

BodyPlans bodyPlans(const std::string& name_or_path) {
  if (name_or_path != "auto") return {loadTemplate(name_or_path)};
  return {loadTemplate("biped"), loadTemplate("quadruped")};
}

const SkeletonTemplate* findPlan(std::string_view name, const BodyPlans& plans) {
  for (const SkeletonTemplate& plan : plans)
    if (plan.name == name) return &plan;
  return nullptr;
}

const SkeletonTemplate& planNamed(std::string_view name, const BodyPlans& plans) {
  const SkeletonTemplate* plan = findPlan(name, plans);
  return plan ? *plan : plans.front();
}

const SkeletonTemplate* planWith(const std::vector<std::string>& joints, const BodyPlans& plans) {
  for (const SkeletonTemplate& plan : plans)
    if (std::all_of(joints.begin(), joints.end(), [&](const auto& name) { return plan.find(name) >= 0; }))
      return &plan;
  return nullptr;
}

std::string otherPlanWith(const std::vector<std::string>& joints, const BodyPlans& plans) {
  if (planWith(joints, plans)) return "";
  for (const std::string& name : builtinTemplates())
    if (planWith(joints, {loadTemplate(name)})) return name;
  return "";
}

std::string otherPlanSaid(const std::vector<std::string>& names, std::size_t drawings,
                          const std::string& theirs, const std::string& asked_for) {
  return std::to_string(names.size()) + " of " + std::to_string(drawings) + " drawings (" + names.front() +
         (names.size() > 1 ? ", ..." : "") + ") have joints of a " + theirs + ", not of a " + asked_for;
}

}  // namespace skel
