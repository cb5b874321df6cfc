// A drawing's file in, the rigged drawing out.
#pragma once

#include <string>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// With the built-in nets, from a picture, or from the .skeleton.json of one (with its mask, if it names one).
// `body_plan`: a name or a file. Throws InputError: cannot be read, no figure in it.
RiggedDrawing rigDrawing(const std::string& path, const std::string& body_plan);

}  // namespace skel
