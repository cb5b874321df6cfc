// The body plans among which a drawing's is found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/skeleton/template.h"

namespace skel {

using BodyPlans = std::vector<SkeletonTemplate>;  // at least one

// That of loadTemplate(), or of "auto" biped and quadruped.
BodyPlans bodyPlans(const std::string& name_or_path);

// The one that is called so; null: none is.
const SkeletonTemplate* findPlan(std::string_view name, const BodyPlans& plans);
// The same; the first if none is.
const SkeletonTemplate& planNamed(std::string_view name, const BodyPlans& plans);

// The first that has all joints of these names; null: none has.
const SkeletonTemplate* planWith(const std::vector<std::string>& joints, const BodyPlans& plans);

// Of joints that none of the plans has: the plan that skel brings along and whose they are, else "".
std::string otherPlanWith(const std::vector<std::string>& joints, const BodyPlans& plans);

// The first of the joints that none of the plans has, nor one that skel brings along: "joints.left_hnad: is
// no joint of the template biped" (of the plans the one that has most of them), else "".
std::string unknownJointAmong(const std::vector<std::string>& joints, const BodyPlans& plans);

// "2 of 6 drawings (box_dog, ...) have joints of a quadruped, not of a biped". `names`: of the two.
std::string otherPlanSaid(const std::vector<std::string>& names, std::size_t drawings,
                          const std::string& theirs, const std::string& asked_for);

}  // namespace skel
