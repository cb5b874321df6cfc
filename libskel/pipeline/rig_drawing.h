// A drawing's file in, the rigged drawing out.
#pragma once

#include <string>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// The defaults, with all built-in clips that fit the body plan (a name or a file).
RigOptions rigOptions(const std::string& body_plan = "biped");

// From a picture, or from the .skeleton.json of one (with its mask, if it names one). encodeGlb() makes a
// file of the result's character and clips. Throws InputError: cannot be read, no figure in it.
RiggedDrawing rigDrawing(const std::string& path, const RigOptions& options = rigOptions());

}  // namespace skel
