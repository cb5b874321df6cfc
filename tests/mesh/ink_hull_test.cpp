#include "libskel/mesh/ink_hull.h"

#include <cmath>

#include "libskel/mesh/outline_band.h"
#include "libskel/mesh/vertex_normals.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

// A circle of which the first `inked` of a hundred samples have a line of 6 px.
std::vector<OutlineSample> rimOf(int inked) {
  std::vector<OutlineSample> rim;
  for (int k = 0; k < 100; ++k) {
    const double angle = 2 * std::numbers::pi * k / 100;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    rim.push_back(
        {.point = Eigen::Vector2d(100, 100) + 80 * out, .width_px = k < inked ? 6.0 : 0.0, .inwards = -out});
  }
  return rim;
}

// White but for a ring where the line is.
Image ring() {
  Image image(200, 200);
  image.rgba.setConstant(255);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      if (const double r = (Eigen::Vector2d(x, y) - Eigen::Vector2d(100, 100)).norm(); r > 74 && r < 80)
        image.rgba.row(y * 200 + x) << 90, 20, 10, 255;
  return image;
}

}  // namespace

TEST_CASE("a figure has the width and the colour of the line that most of its rim has") {
  const InkLine line = inkLine(ring(), rimOf(100), 1000, 0.01);
  CHECK(line.width_m == Approx(0.06));
  CHECK(line.rgb == Eigen::Vector3f(90, 20, 10));
  CHECK(inkLine(ring(), rimOf(61), 1000, 0.01).width_m == Approx(0.06));
  CHECK(inkLine(ring(), rimOf(59), 1000, 0.01).width_m == 0);
  CHECK(inkLine(ring(), {}, 1000, 0.01).width_m == 0);
}

TEST_CASE("a line is no wider than a hundredth or so of the figure") {
  CHECK(inkLine(ring(), rimOf(100), 160, 0.01).width_m == Approx(0.0192));
}

TEST_CASE(
    "a hull stands off the surface by the line's width where that faces the viewer, and by less in the "
    "plane") {
  TriangleMesh mesh = figure().mesh;
  CHECK(inkReach(mesh).size() == 0);
  mesh.ink = {0.01f, Eigen::Vector3f::Zero()};
  const Eigen::VectorXf reach = inkReach(mesh);
  REQUIRE(reach.size() == mesh.vertices.rows());
  CHECK(reach.maxCoeff() == Approx(0.01).epsilon(0.05));
  CHECK(reach.minCoeff() > 0.003f);
  CHECK(reach.minCoeff() < 0.005f);
  const Eigen::Vector3f eye(0, 1, 8);
  const InkHull ink =
      inkHull(mesh.vertices, mesh.triangles, vertexNormals(mesh.vertices, mesh.triangles), reach, eye);
  CHECK(ink.triangles.rows() > 0.1 * double(mesh.triangles.rows()));
  const Eigen::MatrixX3f& hull = ink.vertices;
  const Eigen::MatrixX3f normals = vertexNormals(mesh.vertices, mesh.triangles);
  for (const auto& t : ink.triangles.rowwise()) {
    const Eigen::RowVector3f a = hull.row(t[0]), b = hull.row(t[1]), c = hull.row(t[2]);
    CHECK((b - a).cross(c - a).dot(a - eye.transpose()) < 0);  // to the eye
    // None is only of what looks straight away.
    float least = 1;
    for (const int v : t)
      least = std::min(least, normals.row(v).dot((mesh.vertices.row(v) - eye.transpose()).normalized()));
    CHECK(least < 0.91f);
  }
  for (Eigen::Index v = 0; v < hull.rows(); ++v) {
    const float way = (hull.row(v) - mesh.vertices.row(v)).norm();
    CHECK(way < 0.035f);
    // Behind what it surrounds.
    CHECK((hull.row(v).transpose() - eye).norm() > (mesh.vertices.row(v).transpose() - eye).norm());
  }
}
