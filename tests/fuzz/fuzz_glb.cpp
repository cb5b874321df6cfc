// Rigged characters; what is read is written again.
#include "libskel/import/read_character.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const CharacterFile file = decodeGlb(textOf(data, size), "fuzz.glb");
    require(file.character.mesh.vertices.allFinite(), "vertices are finite");
    require((file.character.weights.weights.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-4f,
            "weights sum to 1");
    const std::string again = encodeGlb(file.character, file.clips, {.name = file.name});
    require(decodeGlb(again, "again.glb").clips.size() <= file.clips.size(), "what is written can be read");
  });
  return 0;
}
