// Skin weights, read back.
#pragma once

#include <string>

#include "libskel/export/write_character.h"

namespace skel {

// A .weights.json (format "skel-skin") for the mesh and the joints of `character`, whose joints it may name
// in any order. Throws InputError with the JSON path: another number of vertices, a joint that the character
// lacks, negative weights, a vertex without any.
SkinWeights readWeights(const std::string& path, const RiggedCharacter& character);

}  // namespace skel
