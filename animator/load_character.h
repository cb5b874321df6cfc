// What the commands can be given as a character and as a motion.
#pragma once

#include <string>
#include <vector>

#include "animator/clip_source.h"
#include "libskel/import/read_character.h"

namespace skel {

// A .glb, or a drawing, which is rigged first with the body plan of that name. Throws InputError: cannot be
// read, no figure in the drawing, an ending that is no character's.
CharacterFile loadCharacter(const std::string& path, const std::string& body_plan);

// The same with the motions of skel that fit it and whose names its own clips leave free.
CharacterFile loadCharacterWithClips(const std::string& path, const std::string& body_plan,
                                     const ClipSource& source = {});

// For the character's rest pose: the motions of skel that fit.
std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source = {});

// A clip of the file, one that comes with skel, or a file that loadClipFor() reads, for the character's rest
// pose. Throws UsageError that lists the names there are, InputError.
Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source = {});

}  // namespace skel
