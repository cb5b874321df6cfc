#include "libskel/pipeline/rig_character.h"

#include "libskel/classifier/weights_file.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

TEST_CASE("a model in parts is bound by its whole front view, not by its largest part") {
  RigInput input;
  input.model = figure().mesh;
  const Eigen::RowVector3f low = input.model->vertices.colwise().minCoeff(),
                           high = input.model->vertices.colwise().maxCoeff();
  // A small pyramid that floats beside the figure.
  TriangleMesh& mesh = *input.model;
  const Eigen::Index first = mesh.vertices.rows(), last = mesh.triangles.rows();
  mesh.vertices.conservativeResize(first + 4, 3);
  mesh.vertices.bottomRows(4) << 2, 1, 0, 2.2f, 1, 0, 2.1f, 1.2f, 0, 2.1f, 1.1f, 0.1f;
  mesh.triangles.conservativeResize(last + 4, 3);
  mesh.triangles.bottomRows(4) << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  mesh.triangles.bottomRows(4).array() += static_cast<int>(first);
  mesh.uv.resize(0, 2);
  mesh.texture = Image();

  RigOptions options;
  options.mlp = defaultMlp();
  options.body_plan = loadTemplate("biped");
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  const RiggedCharacter& character = drawing.character;
  const double unit = kModelHeight_m / (high.y() - low.y());
  const double middle = 0.5 * (low.x() + 2.2f);  // of figure and pyramid
  for (const Joint& joint : character.skeleton.joints) {
    CAPTURE(joint.name);
    CHECK(joint.position.x() > (low.x() - middle) * unit - 0.01);
    CHECK(joint.position.x() < (high.x() - middle) * unit + 0.01);
  }
  const Joint& head = character.skeleton.joints[character.skeleton.index("head")];
  CHECK(head.position.x() == Approx((0.5 * (low.x() + high.x()) - middle) * unit).margin(0.1));
}
