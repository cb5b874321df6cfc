// Characters and clips that a program has put together itself.
#pragma once

#include <vector>

#include "libskel/export/write_character.h"

namespace skel {

// Throws UsageError that says which member is wrong: a character without a mesh (nothing was found, or
// rigging ended at an earlier stage), parts that do not fit each other, what checkMesh(), checkSkeleton() and
// checkClip() refuse, a clip that moves a joint that the skeleton lacks. Throws Error (refused input) where
// readers would refuse a clip's times.
void checkCharacter(const RiggedCharacter& character, const std::vector<Clip>& clips);

}  // namespace skel
