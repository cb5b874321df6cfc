// A drawing's file in, the rigged drawing out.
#pragma once

#include <string>
#include <string_view>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// The defaults, with all built-in clips that fit the body plan: a name, a file, or "auto": biped or
// quadruped, whichever a figure fits.
RigOptions rigOptions(const std::string& body_plan = "auto");
RigOptions rigOptionsWithoutClips(const std::string& body_plan);

// Which of the options' body plans a skeleton file belongs to; the first if to none of them.
const SkeletonTemplate& planOfSkeleton(std::string_view text, const std::string& path,
                                       const RigOptions& options);

// From a picture, or from the .skeleton.json of one (with its mask, if it names one). encodeGlb() makes a
// file of the result's character and clips. Throws InputError: cannot be read, no figure in it (found() of
// what comes back is true), a mask of another size; UsageError as rigCharacter() does; nothing but an Error
// leaves it.
RiggedDrawing rigDrawing(const std::string& path, const RigOptions& options = rigOptions());

}  // namespace skel
