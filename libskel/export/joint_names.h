// What other programs call our joints.
#pragma once

#include <string>
#include <vector>

#include "libskel/export/write_character.h"

namespace skel {

// kVrm: VRM 1.0's humanoid bones (its 15 required ones are covered). kMixamo: Mixamo's names with their
// prefix. Joints that those do not know keep their own name.
std::string exportedJointName(const std::string& joint, JointNaming naming);

// Whether those names have a meaning for it: they are those of bipeds.
bool namesFit(const Skeleton& skeleton, JointNaming naming);

// Of all joints, in their order, as different as they are: one whose name there is another joint's already
// keeps its own. All keep theirs where the names do not fit.
std::vector<std::string> exportedJointNames(const Skeleton& skeleton, JointNaming naming);

}  // namespace skel
