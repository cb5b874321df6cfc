// What the commands can be given as a character and as a motion.
#pragma once

#include <string>
#include <vector>

#include "animator/clip_source.h"
#include "libskel/import/read_character.h"
#include "libskel/pipeline/rig_drawing.h"

namespace CLI {
class App;
}

namespace skel {

struct CharacterSource {
  std::string path;                // a .glb, a drawing, or a model with a skeleton of its own
  std::string body_plan = "auto";  // of a drawing
  std::string skeleton = {};       // of a model (.obj): see readRigModel()
  std::string up = "auto";
};
// FILE, --template, --skeleton, --up.
void bindCharacterSource(CLI::App& app, CharacterSource& source);

// A drawing is rigged first, a model bound. Throws InputError: cannot be read, no figure in the drawing, a
// model without a skeleton, an ending that is no character's.
CharacterFile loadCharacter(const CharacterSource& source);

// A drawing, rigged, with all that was found on the way. Throws UsageError if the source is none, InputError.
RiggedDrawing loadDrawing(const CharacterSource& source);

// The same with the motions of skel that fit it and whose names its own clips leave free.
CharacterFile loadCharacterWithClips(const CharacterSource& source, const ClipSource& clips = {});

// For the character's rest pose: the motions of skel that fit.
std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source = {});

// A clip of the file, one that comes with skel, or a file that loadClipFor() reads, for the character's rest
// pose. Throws UsageError that lists the names there are, InputError.
Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source = {});

}  // namespace skel
