// Rigged characters; what is read is written again.
#include "libskel/animation/bvh.h"
#include "libskel/animation/role_figure.h"
#include "libskel/export/formats.h"
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
    roleFigure(file.character.skeleton);
    const std::vector<Clip> none;
    const ExportOptions options{.name = "fuzz", .naming = JointNaming::kVrm};
    const std::size_t joints = file.character.skeleton.joints.size();
    constexpr std::size_t kMostBvh = 1000;  // joints
    if (joints > kMostBvh) return;
    const std::string bvh = exportBvh({file.character, none, options})[0].bytes;
    bool read = false;
    mayRefuse([&] { read = parseBvh(bvh, "again.bvh").skeleton.joints.size() == joints; });
    require(read, "what is written as BVH can be read");
  });
  return 0;
}
