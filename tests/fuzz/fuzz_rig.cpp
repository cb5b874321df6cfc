// Skeletons with heads and tails, bound to a small model by every method.
#include "libskel/skeleton/place_in_mesh.h"
#include "libskel/skeleton/rig_file.h"
#include "libskel/skin/skin_weights.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  TriangleMesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << -1, 0, -1, 1, 0, -1, 0, 0, 1, 0, 2, 0, 0.2f, 2.1f, 0;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0;
  mayRefuse([&] {
    const Skeleton skeleton = readRigFile(fileOf(textOf(data, size), "fuzz.json"));
    require(!skeleton.joints.empty() && skeleton.joints[0].parent < 0, "there is one root");
    for (std::size_t j = 1; j < skeleton.joints.size(); ++j)
      require(skeleton.joints[j].parent >= 0 && skeleton.joints[j].parent < static_cast<int>(j),
              "parents come first");
    const double share = shareInside(skeleton, mesh);
    require(share >= 0 && share <= 1, "a share is in [0, 1]");
    for (const SkinMethod method : skinMethods()) {
      const SkinWeights weights = computeSkinWeights(mesh, skeleton, method);
      require((weights.weights.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-4f, "weights sum to 1");
    }
  });
  return 0;
}
