// How the commands that bind are asked for weights.
#pragma once

#include <string>

#include "libskel/export/write_character.h"

namespace CLI {
class App;
}

namespace skel {

struct SkinRequest {
  std::string method = "geodesic";
  int max_influences = 4;
  int smoothing = 0;
  std::string regions;  // a file; empty: built in
};
// --skin, --max-influences, --smoothing, --regions.
void bindSkinRequest(CLI::App& app, SkinRequest& request);

// Throws InputError, which names `file`, the character's.
SkinWeights weightsFor(const RiggedCharacter& character, const std::string& file, const SkinRequest& request);

}  // namespace skel
