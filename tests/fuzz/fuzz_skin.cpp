// Skin weights, for a small model.
#include "libskel/import/read_weights.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const RiggedCharacter character = [] {
    RiggedCharacter made;
    made.skeleton = figureSkeleton();
    made.mesh.vertices = Eigen::MatrixX3f::Random(3, 3);
    made.mesh.triangles.resize(1, 3);
    made.mesh.triangles << 0, 1, 2;
    return made;
  }();
  mayRefuse([&] {
    const SkinWeights weights = readWeights(fileOf(textOf(data, size), "fuzz.weights.json"), character);
    require(weights.weights.rows() == 3 && weights.weights.minCoeff() >= 0 &&
                (weights.weights.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-4f,
            "weights of a vertex are not negative and sum to 1");
    require(weights.joints.maxCoeff() < static_cast<int>(character.skeleton.joints.size()),
            "weights name joints");
  });
  return 0;
}
