#include "libskel/import/read_character.h"
#include "tests/support/skin_checks.h"
#include "tests/tools/tools.h"

using namespace skel;

TEST_CASE("the OBJ and the weights of a drawing, bound, are the GLB of the drawing") {
  const TempDir dir;
  writeFigure(dir.file("a.png"));
  done(dir, "skel-infer a.png --formats glb,obj,weights,json --clips none");
  for (const std::string model : {"a.obj", "a.glb"}) {
    const std::string skeleton = model == "a.obj" ? " --skeleton out/a.skeleton.json" : "";
    done(dir, "skel-animate bind out/" + model + skeleton + " --weights out/a.weights.json -o bound.glb");
    const RiggedCharacter drawn = readGlb(dir.file("out/a.glb")).character,
                          bound = readGlb(dir.file("bound.glb")).character;
    REQUIRE(bound.mesh.vertices.rows() == drawn.mesh.vertices.rows());
    CHECK((bound.mesh.vertices - drawn.mesh.vertices).cwiseAbs().maxCoeff() < 1e-5f);
    CHECK((bound.mesh.triangles == drawn.mesh.triangles));
    const Eigen::MatrixXf is = denseWeights(bound.weights, bound.skeleton),
                          should_be = denseWeights(drawn.weights, drawn.skeleton);
    CHECK((is - should_be).cwiseAbs().maxCoeff() < 5e-5f);
  }
}
