// What a person should know of a drawing that was rigged: one sentence a note.
#pragma once

#include <string>
#include <vector>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// Of the figure, its joints and its body plan.
std::vector<std::string> figureNotes(const RiggedDrawing& drawing);

// Of limbs that these clips, which are relative to the rest pose, do not move as limbs should; nothing where
// the joints are a guess. `file`: what skel-label is to open.
std::vector<std::string> limbNotes(const RiggedDrawing& drawing, const std::vector<Clip>& clips,
                                   const std::string& file);

}  // namespace skel
