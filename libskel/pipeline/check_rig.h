// What a program hands in to be rigged.
#pragma once

#include "libskel/pipeline/rig_character.h"

namespace skel {

// Throws UsageError, one sentence that names the member, for whatever rigCharacter() could only break off at:
// sizes that do not fit each other, numbers that are not finite or outside of what their member is for, a
// skeleton or a body plan that is no tree, clips with keys that are none. Error (refused input) for a clip
// that lasts too long. Looks at no pixel, but at a model's vertices and at the clips' keys.
void checkRig(const RigInput& input, const RigOptions& options);

}  // namespace skel
