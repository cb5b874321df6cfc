// A character at a moment of a clip.
#pragma once

#include "libskel/animation/clip.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/export/write_character.h"

namespace skel {

// Of its mesh, which is the unit of Clip::root_translations.
float heightOf(const RiggedCharacter& character);

// The character's joints in the clip at that moment; past the end it plays again.
JointTransforms posedAt(const RiggedCharacter& character, const Clip& clip, double time_s);

}  // namespace skel
