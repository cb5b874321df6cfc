#include "libskel/import/read_weights.h"

#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;

TEST_CASE("weights that name one joint again and again do not look through all joints for each name") {
  // 10^10 steps.
  RiggedCharacter character;
  for (int i = 0; i < 4096; ++i) character.skeleton.joints.emplace_back().name = "joint" + std::to_string(i);
  character.mesh.vertices.setZero(1, 3);
  std::string text = R"({"format": "skel-skin", "version": 1, "joints": [)";
  for (int i = 0; i < 1'500'000; ++i) text += "\"joint4095\",";
  text += R"("joint7"], "vertices": [{"joints": [1500000, 0], "weights": [0.75, 0.25]}]})";
  const TempDir dir;
  writeFile(dir.file("a.weights.json"), text);
  const SkinWeights weights = readWeights(dir.file("a.weights.json"), character);
  CHECK(weights.joints(0, 0) == 7);
  CHECK(weights.joints(0, 1) == 4095);
}
