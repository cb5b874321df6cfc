#include "libskel/mesh/front_view.h"

#include "libskel/mesh/inflate.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

TEST_CASE("the front view of an inflated figure is the figure") {
  const Silhouette silhouette = silhouetteFromMask(capsuleMask());
  TriangleMesh mesh = inflate(capsuleImage(), silhouette);
  mesh.vertices *= 3;
  const FrontView view = frontSilhouette(mesh, 300);
  CHECK(std::max(view.mask.rows(), view.mask.cols()) == 304);
  int wrong = 0, pixels = 0;
  for (int y = 0; y < view.mask.rows(); ++y) {
    for (int x = 0; x < view.mask.cols(); ++x) {
      const Eigen::Vector2d p =
          mesh.model_from_image.inverse(view.model_from_image(Eigen::Vector2d(x, y)) / 3);
      const int u = static_cast<int>(std::lround(p.x())), v = static_cast<int>(std::lround(p.y()));
      const bool in = u >= 0 && v >= 0 && u < 400 && v < 400 && silhouette.mask(v, u) != 0;
      pixels += in;
      wrong += in != (view.mask(y, x) != 0);
    }
  }
  CHECK(wrong < 0.04 * pixels);

  const ModelFromImage bound = bindByBoundingBox(view.mask, mesh);
  const Eigen::Vector2d p(40, 70);
  CHECK((bound(p) - view.model_from_image(p)).norm() < 0.02 * 3 * kModelHeight_m);
  CHECK((bound.inverse(bound(p)) - p).norm() < 1e-9);

  standUpright(mesh);
  CHECK(mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-6));
  CHECK(mesh.vertices.col(1).maxCoeff() == Approx(kModelHeight_m));
}

TEST_CASE("models of any unit are stood upright") {
  for (const float unit : {1e-38f, 1e-3f, 3e38f}) {
    TriangleMesh mesh;
    mesh.vertices.resize(3, 3);
    mesh.vertices << -unit, -unit, 0, unit, -unit, 0, 0, unit, unit;
    standUpright(mesh);
    CHECK(mesh.vertices.row(0).isApprox(Eigen::RowVector3f(-0.85f, 0, -0.425f)));
    CHECK(mesh.vertices.row(2).isApprox(Eigen::RowVector3f(0, 1.7f, 0.425f)));
  }
}

TEST_CASE("a model of other proportions is bound with a scale for each axis") {
  TriangleMesh box;
  box.vertices.resize(3, 3);
  box.vertices << -2, 0, 0, 2, 0, 0, 0, 1, 0;
  box.triangles.resize(1, 3);
  box.triangles << 0, 1, 2;
  Plane8 mask = Plane8::Zero(100, 60);
  mask.block(10, 20, 80, 40).setConstant(255);
  const ModelFromImage model_from_image = bindByBoundingBox(mask, box);
  CHECK((model_from_image(Eigen::Vector2d(19.5, 9.5)) - Eigen::Vector2d(-2, 1)).norm() < 1e-9);
  CHECK((model_from_image(Eigen::Vector2d(59.5, 89.5)) - Eigen::Vector2d(2, 0)).norm() < 1e-9);
}
