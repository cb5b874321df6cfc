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

std::string unknownJointAmong(const std::vector<std::string>& joints, const BodyPlans& plans) {
  const auto has = [](const SkeletonTemplate& plan, const std::string& name) { return plan.find(name) >= 0; };
  BodyPlans all = plans;
  for (const std::string& name : builtinTemplates()) all.push_back(loadTemplate(name));
  const auto unknown = std::find_if(joints.begin(), joints.end(), [&](const std::string& name) {
    return std::none_of(all.begin(), all.end(), [&](const auto& plan) { return has(plan, name); });
  });
  if (unknown == joints.end()) return "";
  const auto known = [&](const SkeletonTemplate& plan) {
    return std::count_if(joints.begin(), joints.end(), [&](const auto& name) { return has(plan, name); });
  };
  const auto nearest = std::max_element(plans.begin(), plans.end(), [&](const auto& plan, const auto& other) {
    return known(plan) < known(other);
  });
  return "joints." + *unknown + ": is no joint of the template " + nearest->name;
}

std::string otherPlanSaid(const std::vector<std::string>& names, std::size_t drawings,
                          const std::string& theirs, const std::string& asked_for) {
  return std::to_string(names.size()) + " of " + std::to_string(drawings) + " drawings (" + names.front() +
         (names.size() > 1 ? ", ..." : "") + ") have joints of a " + theirs + ", not of a " + asked_for;
}

}  // namespace skel
