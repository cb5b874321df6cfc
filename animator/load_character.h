// What the commands can be given as a character.
#pragma once

#include <string>
#include <vector>

#include "libskel/import/read_character.h"

namespace skel {

struct LoadOptions {
  std::string body_plan = "biped";  // of a drawing
  std::vector<Clip> clips;          // for the canonical pose: retargeted to the character
};

// A .glb, or a drawing, which is rigged first. The clips of the options come behind those of the file. Throws
// InputError: cannot be read, no figure in the drawing, an ending that is no character's.
CharacterFile loadCharacter(const std::string& path, const LoadOptions& options);

// Whether the file is a drawing, by its ending.
bool isDrawing(const std::string& path);

}  // namespace skel
