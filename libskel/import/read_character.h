// Rigged characters, read back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/export/write_character.h"

namespace skel {

struct CharacterFile {
  RiggedCharacter character;  // Joint::image and mesh.model_from_image are not known: zeros, the identity
  std::vector<Clip> clips;    // relative to the character's rest pose
  std::string name;           // of the scene
  BoneStyle bones = BoneStyle::kAlong;
  bool ink_hull = false;  // ExportOptions::ink_hull
};

// glTF 2.0 binary, as encodeGlb() writes it: one skinned mesh of one primitive (an ink hull apart) with at
// most 4 influences a vertex, joints that stand unscaled in the rest pose, everything inside the file,
// animations with LINEAR samplers. Joints may have any axes; clips come in the model's. Joints that
// encodeGlb() put at the ends of bones are left out. With `bones` it gives back the same bytes (the texture's
// if it was ours), but for the last bits of rotations. Throws InputError with the place in the glTF document.
CharacterFile readGlb(const std::string& path);
// `file` is the name that complaints use.
CharacterFile decodeGlb(std::string_view bytes, const std::string& file);

// Who wrote a GLB file (ExportOptions::generator); "": it does not say so, or is none that can be read.
// It does not become an input by that: it may be about to be replaced.
std::string generatorOfGlb(const std::string& path);

}  // namespace skel
