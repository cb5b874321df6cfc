// What a teacher is told of a figure, in whole sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

// How warnings of a silhouette end.
inline constexpr std::string_view kLookAtMask = ": look at the mask (skel-label FILE)";

// Of a picture that shows no figure.
inline constexpr const char* kAdviceOnNothing =
    "Nothing was found on it. If something is drawn there, go over its lines with a felt pen and take the "
    "photo by day, from straight above.";

// Of one that an earlier photo of this name was mended for.
inline constexpr const char* kAdviceOnLeftOut =
    "What you had mended of an earlier photo is left out. Look at this one, skel-label FILE: Shift R finds "
    "all anew, Enter says that what is there fits.";

// One sentence a warning of the file: what is unusual, and what helps. `mend_file`: what skel-label opens;
// `plan_is_chosen`: nets have chosen the body plan.
std::vector<std::string> adviceOn(const RiggedDrawing& drawing, const SkeletonFile& file,
                                  const std::string& mend_file, bool plan_is_chosen);

}  // namespace skel
