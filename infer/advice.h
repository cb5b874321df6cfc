// What a teacher is told of a figure, in whole sentences.
#pragma once

#include <string>
#include <vector>

#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

// What is unusual, and what helps. Nothing where all is well.
std::vector<std::string> adviceOn(const RiggedDrawing& drawing, const SkeletonFile& file, bool all_figures);

}  // namespace skel
