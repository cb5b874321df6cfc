// `<stem>.weights.json`, read back.
#pragma once

#include <string>

#include "libskel/export/write_character.h"

namespace skel {

// For that mesh and skeleton. Throws InputError with the JSON path: another number of vertices, joints that
// the skeleton lacks, weights that do not sum to 1.
SkinWeights readSkinFile(const std::string& path, const RiggedCharacter& character);

}  // namespace skel
