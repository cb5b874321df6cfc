// What the commands can be given as a character and as a motion.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "animator/clip_source.h"
#include "libskel/cli/named_numbers.h"
#include "libskel/core/error.h"
#include "libskel/import/read_character.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/rig_character.h"

namespace CLI {
class App;
}

namespace skel {

class FormerNames;

struct CharacterSource {
  std::string path;                  // a .glb, a drawing, or a model with a skeleton of its own
  std::string body_plan = "auto";    // of a drawing
  std::optional<double> alpha = {};  // of a drawing: see SilhouetteOptions
  int figure = 1;                    // of a drawing: 1 is the largest
  // Of a model (.obj): see readRigModel(). Of a drawing: a .skeleton.json or .labels.json of it.
  std::string skeleton = {};
  std::string up = "auto";
  bool upright = false;       // the figure of a drawing is not turned: try no other orientations
  bool cut_limbs = false;     // of a drawing, see RigOptions
  NamedNumbers heights = {};  // of drawings, m; 0: the body plan's own
  NamedNumbers facing = {.of_others = std::nan("")};  // of drawings, degrees, see RigOptions::facing_rad
  std::string results = {};  // of a drawing: a folder that skel-infer has written to; "": none
  bool force = false;        // leave out what was mended by hand
  std::shared_ptr<FormerNames> former_names = {};  // of a run over many drawings
};
// FILE, and the options of the next one.
void bindCharacterSource(CLI::App& app, CharacterSource& source);
// --template, --alpha, --figure, --upright, --cut-limbs, --height, --skeleton, --up, --results, --force.
void bindCharacterOptions(CLI::App& app, CharacterSource& source);

// By the ending of the source's name.
bool isDrawing(const CharacterSource& source);
struct DrawnCharacter {
  RiggedDrawing drawing;
  std::vector<std::string> warnings;  // of the figure and its joints, a clause each
  std::vector<Note> mended;           // of what a person has made for it: taken up, or left out
};
// With the motions of skel that fit it, and with what a person has mended (libskel/mended/mend_places.h), as
// skel-infer takes it up. Throws InputError.
DrawnCharacter rigDrawing(const CharacterSource& source, const ClipSource& clips = {});

// A drawing is rigged first, with the motions of skel that fit it, a model bound. Throws InputError: cannot
// be read, no figure in the drawing, a model without a skeleton, an ending that is no character's. `note` (or
// null): DrawnCharacter::warnings and ::mended or RigModel::warning, for the user; may be empty.
CharacterFile loadCharacter(const CharacterSource& source, const ClipSource& clips = {},
                            std::string* note = nullptr);

// Of a .glb alone. Throws InputError, of a drawing one that says how to make a .glb of it.
CharacterFile loadModel(const std::string& path);

// Adds the motions of skel that fit it and whose names its own clips leave free. Those that it cannot do for
// all that are returned, as what is wrong with each.
std::vector<Error> addLibrary(CharacterFile& file, const ClipSource& clips = {});
// Both. `note` tells of clip files that are left out, too.
CharacterFile loadCharacterWithClips(const CharacterSource& source, const ClipSource& clips = {},
                                     std::string* note = nullptr);

// For the character's rest pose: the motions of skel that fit.
std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source = {});

// A clip of the file, one that comes with skel, or a file that loadClipFor() reads, for the character's rest
// pose. Throws UsageError that lists the names there are, InputError.
Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source = {},
             ClipNotes* notes = nullptr);
Clip clipFor(const std::string& name_or_path, const RiggedCharacter& character,
             const std::vector<Clip>& own_clips, const ClipSource& source = {}, ClipNotes* notes = nullptr);

}  // namespace skel
