#include "libskel/draw/render_mesh.h"

#include <numbers>

#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

double covered(const Image& image) { return image.rgba.col(3).cast<double>().sum() / 255; }

// A square of 1 m, facing +z, whose texture is black at the left and white at the right.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << -0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 1, 0, -0.5f, 1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.uv.resize(4, 2);
  mesh.uv << 0, 1, 1, 1, 1, 0, 0, 0;
  mesh.texture = Image(2, 2);
  mesh.texture.rgba.setConstant(255);
  for (const int y : {0, 1})
    for (int c = 0; c < 3; ++c) mesh.texture.pixel(0, y)[c] = 0;
  return mesh;
}

}  // namespace

TEST_CASE("a square has its size and its texture the right way round") {
  const TriangleMesh mesh = square();
  Camera camera;
  camera.target = {0, 0.5, 0};
  RenderOptions options{.width = 100, .height = 100, .shading = 0};
  const Image image = renderMesh(mesh.vertices, mesh, camera, options);
  CHECK(covered(image) == Approx(2500).epsilon(0.03));
  CHECK(image.pixel(10, 50)[3] == 0);
  CHECK(image.pixel(28, 50)[0] < 30);
  CHECK(image.pixel(72, 50)[0] > 225);

  // From its left side (the model's +x) it is foreshortened to nothing, from behind mirrored.
  camera.yaw_rad = std::numbers::pi / 2;
  CHECK(covered(renderMesh(mesh.vertices, mesh, camera, options)) < 60);
  camera.yaw_rad = std::numbers::pi;
  CHECK(renderMesh(mesh.vertices, mesh, camera, options).pixel(28, 50)[0] > 225);
}

TEST_CASE("shade keeps the hue, and white paper does not turn dirty grey") {
  TriangleMesh mesh = square();
  mesh.texture.rgba.setConstant(255);
  Camera camera;
  camera.target = {0, 0.5, 0};
  mesh.vertices.col(2) += 0.8f * mesh.vertices.col(1);  // faces the ground, the light comes from above
  const RenderOptions options{.width = 100, .height = 100};
  const auto seen = [&](int r, int g, int b) {
    for (Eigen::Index i = 0; i < mesh.texture.rgba.rows(); ++i) mesh.texture.rgba.row(i) << r, g, b, 255;
    const Image image = renderMesh(mesh.vertices, mesh, camera, options);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    int count = 0;
    for (Eigen::Index i = 0; i < image.rgba.rows(); ++i)
      if (image.rgba(i, 3) == 255) {
        for (int c = 0; c < 3; ++c) mean[c] += image.rgba(i, c);
        ++count;
      }
    REQUIRE(count > 50);
    return Eigen::Vector3d(mean / count);
  };
  const Eigen::Vector3d red = seen(200, 60, 30), white = seen(255, 255, 255);
  REQUIRE(red[0] < 180);  // in the shade
  CHECK(red[1] / red[0] == Approx(60.0 / 200).margin(0.01));
  CHECK(red[2] / red[0] == Approx(30.0 / 200).margin(0.01));
  CHECK(white.minCoeff() > 200);
  CHECK(255 - white[0] < 0.6 * (255 - 255 * red[0] / 200));
}

TEST_CASE("what is nearer hides what is farther, whatever comes first") {
  TriangleMesh mesh = square();
  mesh.uv.resize(0, 2);
  const Eigen::MatrixX3f one = mesh.vertices;
  mesh.vertices.resize(8, 3);
  mesh.vertices << one, one;
  mesh.vertices.bottomRows(4).col(2).array() += 0.1f;
  mesh.vertices.bottomRows(4).leftCols(2) *= 0.5f;
  Eigen::MatrixX3i triangles(4, 3);
  triangles << mesh.triangles, mesh.triangles.array() + 4;
  Camera camera;
  camera.target = {0, 0.5, 0};
  // The nearer one is turned from the light by the order of its corners.
  triangles.bottomRows(2).col(1).swap(triangles.bottomRows(2).col(2));
  mesh.triangles = triangles;
  const Image front = renderMesh(mesh.vertices, mesh, camera, {.width = 60, .height = 60});
  mesh.triangles << triangles.bottomRows(2), triangles.topRows(2);
  const Image again = renderMesh(mesh.vertices, mesh, camera, {.width = 60, .height = 60});
  CHECK((front.rgba == again.rgba).all());
  CHECK(front.pixel(30, 38)[0] < front.pixel(30, 20)[0] - 20);
}

TEST_CASE("the framing camera shows all of a figure from any side, and not too small") {
  const RiggedCharacter character = figure({.right_arm = 90, .right_forearm = 90});
  for (double yaw = -3; yaw < 3.1; yaw += 0.7)
    for (const double pitch : {-0.5, 0.0, 0.6}) {
      const Camera camera = framingCamera(character.mesh.vertices, yaw, pitch, 0.5);
      const Image image = renderMesh(character.mesh.vertices, character.mesh, camera,
                                     {.width = 100, .height = 200, .samples = 1});
      int left = 100, right = -1, top = 200, bottom = -1;
      for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 100; ++x)
          if (image.pixel(x, y)[3] > 0) {
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
          }
      CAPTURE(yaw, pitch);
      CHECK(left > 0);
      CHECK(top > 0);
      CHECK(right < 99);
      CHECK(bottom < 199);
      CHECK((right - left > 80 || bottom - top > 160));
    }
}

TEST_CASE("an empty mesh gives a clear picture") {
  CHECK(covered(renderMesh(Eigen::MatrixX3f(0, 3), TriangleMesh(), Camera(), {.width = 4, .height = 3})) ==
        0);
}
