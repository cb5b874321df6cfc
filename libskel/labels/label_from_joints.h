// Classes of candidates where the joints are known: the class of the nearest bone, by the template's table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/labels/label_file.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// One entry for each of candidates.maxima; joints that the template derives are derived where they are not
// given. Nullopt where the nearest bone may be one that lacks a joint; all, if no bone can be formed. Names
// that the template does not have are ignored. `recognized` names the joints that no person has placed: what
// is nearest to a bone of theirs gets no class, since nobody has said where that bone is. A joint that the
// template derives counts as placed where those are that it follows from.
std::vector<std::optional<JointClass>> labelFromJoints(const CandidateSet& candidates,
                                                       const WorkingGrid& grid, const NamedJoints& joints,
                                                       const SkeletonTemplate& body_plan,
                                                       const std::vector<std::string>& recognized = {});

}  // namespace skel
