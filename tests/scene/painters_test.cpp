#include <map>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/scene/scene.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

// All that there are here.
std::map<std::string, std::unique_ptr<MeshPainter>> painters(const TriangleMesh& mesh) {
  std::map<std::string, std::unique_ptr<MeshPainter>> all;
  all["software"] = softwarePainter(mesh);
  try {
    all["gl"] = offscreenPainter(mesh);
  } catch (const UnavailableError& error) {
    WARN("no OpenGL: " << error.what());
  }
  return all;
}

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

double covered(const Image& image) { return image.rgba.col(3).cast<double>().sum() / 255; }

// Mean difference of the colours over white, 0…255.
double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.rgba.rows(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto over = [&](const Image& image) {
        const double alpha = image.rgba(i, 3) / 255.0;
        return alpha * image.rgba(i, k) + (1 - alpha) * 255;
      };
      sum += std::abs(over(a) - over(b));
    }
  return sum / double(3 * a.rgba.rows());
}

}  // namespace

TEST_CASE("every painter shows a square at its size, its texture the right way round") {
  const TriangleMesh mesh = square();
  for (const auto& [name, painter] : painters(mesh)) {
    CAPTURE(name);
    Camera camera;
    camera.target = {0, 0.5, 0};
    Surface surface;
    surface.shading = 0;
    const Image image = painter->paint(mesh.vertices, camera, 100, 100, surface);
    CHECK(covered(image) == Approx(2500).epsilon(0.02));
    CHECK(image.pixel(10, 50)[3] == 0);
    CHECK(image.pixel(28, 50)[0] < 30);
    CHECK(image.pixel(72, 50)[0] > 225);
    // From behind: an open mesh is seen from both sides.
    camera.yaw_rad = std::numbers::pi;
    CHECK(painter->paint(mesh.vertices, camera, 100, 100, surface).pixel(28, 50)[0] > 225);
    // Half a pixel off: edges are smooth.
    camera.yaw_rad = 0;
    camera.target.x() += 0.5 * camera.view_height_m / 100;
    const int edge = painter->paint(mesh.vertices, camera, 100, 100, surface).pixel(24, 50)[3];
    CHECK((edge > 60 && edge < 200));
  }
}

TEST_CASE("every painter shows what renderMesh shows") {
  const RiggedCharacter character = figure({.right_arm = 80, .right_forearm = 120});
  for (const auto& [name, painter] : painters(character.mesh))
    for (const double yaw : {0.0, 1.0, 2.5}) {
      CAPTURE(name, yaw);
      const Camera camera = framingCamera(character.mesh.vertices, yaw, 0.2);
      const Image expected = renderMesh(character.mesh.vertices, character.mesh, camera,
                                        {.width = 200, .height = 200, .samples = 4});
      const Image image = painter->paint(character.mesh.vertices, camera, 200, 200, {});
      CHECK(difference(image, expected) < 0.6);
      CHECK(covered(image) == Approx(covered(expected)).epsilon(0.01));
    }
}

TEST_CASE(
    "every painter shows the drawn line around a figure, alike, and only around a fill of its own colours") {
  RiggedCharacter character = figure({.right_arm = 80, .right_forearm = 120});
  const auto plain = painters(character.mesh);
  character.mesh.ink = {0.02f, {200, 0, 100}};
  const Eigen::MatrixX3f colors = Eigen::MatrixX3f::Constant(character.mesh.vertices.rows(), 3, 77);
  for (const auto& [name, painter] : painters(character.mesh))
    for (const double yaw : {0.0, 1.57, 2.5}) {
      CAPTURE(name, yaw);
      const Camera camera = framingCamera(character.mesh.vertices, yaw, 0.2);
      const auto paint = [&](MeshPainter& by, const Surface& surface) {
        return by.paint(character.mesh.vertices, camera, 200, 200, surface);
      };
      const Image with = paint(*painter, {}), without = paint(*plain.at(name), {});
      CHECK(covered(with) > 1.03 * covered(without));
      // What faces the viewer stays as it was.
      int inside = 0;
      for (Eigen::Index i = 0; i < with.rgba.rows(); ++i)
        inside += without.rgba(i, 3) == 255 && (with.rgba.row(i) == without.rgba.row(i)).all();
      CHECK(inside > 0.75 * covered(without));
      const Image expected = renderMesh(character.mesh.vertices, character.mesh, camera,
                                        {.width = 200, .height = 200, .samples = 4});
      CHECK(difference(with, expected) < 0.8);
      Surface colored, translucent, wires, off;
      colored.colors = &colors;
      translucent.opacity = 0.5f;
      wires.fill = false, wires.wires = true;
      off.ink = false;
      for (const Surface& surface : {colored, translucent, wires, off})
        CHECK((paint(*painter, surface).rgba == paint(*plain.at(name), surface).rgba).all());
    }
}

TEST_CASE("every painter gives the same bytes twice, in wires, colours and translucent as well") {
  const RiggedCharacter character = figure();
  const Eigen::MatrixX3f colors = Eigen::MatrixX3f::Constant(character.mesh.vertices.rows(), 3, 77);
  const Camera camera = framingCamera(character.mesh.vertices, 0.5, 0.2);
  std::vector<Surface> looks(5);
  looks[1].wires = true;
  looks[2].wires = true, looks[2].fill = false;
  looks[3].opacity = 0.4f, looks[3].wires = true;
  looks[4].colors = &colors;
  std::map<std::string, std::vector<Image>> all;
  for (const auto& [name, painter] : painters(character.mesh)) {
    CAPTURE(name);
    const auto again = painters(character.mesh);
    for (const Surface& look : looks) {
      const Image image = painter->paint(character.mesh.vertices, camera, 480, 360, look);
      CHECK((image.rgba == painter->paint(character.mesh.vertices, camera, 480, 360, look).rgba).all());
      CHECK(
          (image.rgba == again.at(name)->paint(character.mesh.vertices, camera, 480, 360, look).rgba).all());
      all[name].push_back(image);
    }
    const std::vector<Image>& images = all[name];
    CHECK(difference(images[0], images[1]) > 1);
    CHECK(covered(images[2]) < 0.8 * covered(images[0]));
    CHECK(covered(images[3]) < 0.9 * covered(images[0]));
    CHECK(difference(images[4], images[0]) > 1);
  }
  // And all of them show the same, but for wires without a body, whose smooth edges hide what lies behind
  // them.
  for (const auto& [name, images] : all)
    for (std::size_t i = 0; i < looks.size(); ++i) {
      CAPTURE(name, i);
      CHECK(difference(images[i], all.at("software")[i]) < (!looks[i].fill ? 6 : looks[i].wires ? 2.5 : 0.6));
    }
}

TEST_CASE("a mesh in several parts, of which one looks inwards, hides nothing") {
  TriangleMesh mesh = figure().mesh;
  const Eigen::Index count = mesh.vertices.rows(), faces = mesh.triangles.rows();
  const Camera camera = framingCamera(mesh.vertices);
  const Image right = softwarePainter(mesh)->paint(mesh.vertices, camera, 100, 100, {});
  // A second body of its own, far behind, turned inside out.
  mesh.vertices.conservativeResize(2 * count, 3);
  mesh.vertices.bottomRows(count) = mesh.vertices.topRows(count);
  mesh.vertices.bottomRows(count).col(2).array() -= 1;
  mesh.triangles.conservativeResize(2 * faces, 3);
  mesh.triangles.bottomRows(faces) = mesh.triangles.topRows(faces).array() + int(count);
  mesh.triangles.bottomRows(faces).col(1).swap(mesh.triangles.bottomRows(faces).col(2));
  if (mesh.uv.rows() > 0) {
    mesh.uv.conservativeResize(2 * count, 2);
    mesh.uv.bottomRows(count) = mesh.uv.topRows(count);
  }
  const Image both = softwarePainter(mesh)->paint(mesh.vertices, camera, 100, 100, {});
  int differ = 0;
  for (Eigen::Index i = 0; i < both.rgba.rows(); ++i)
    if (right.rgba(i, 3) == 255 && !(both.rgba.row(i) == right.rgba.row(i)).all()) ++differ;
  CHECK(differ == 0);
}

TEST_CASE("nothing to paint gives a clear picture") {
  for (const auto& [name, painter] : painters(TriangleMesh())) {
    CAPTURE(name);
    CHECK(covered(painter->paint(Eigen::MatrixX3f(0, 3), Camera(), 4, 3, {})) == 0);
  }
}

TEST_CASE("a scene puts background, shadow, body and skeleton over one another") {
  const RiggedCharacter character = figure();
  const Scene scene(character, softwarePainter(character.mesh));
  const JointTransforms rest(character.skeleton.joints.size(), Eigen::Affine3f::Identity());
  const Camera camera = framingCamera(character.mesh.vertices, 0, 0.2);
  const auto seen = [&](const Look& look) { return scene.paint(rest, camera, 160, 160, look); };
  Look look;
  look.background = {10, 20, 30};
  const Image with_shadow = seen(look);
  CHECK(int(with_shadow.pixel(0, 0)[1]) == 20);
  look.shadow = false;
  const Image bare = seen(look);
  CHECK(difference(with_shadow, bare) > 0.01);
  look.skeleton = true;
  const Image boned = seen(look);
  const Projection project(camera, 160, 160);
  const Eigen::Vector2d hand =
      *project(character.skeleton.joints[std::size_t(character.skeleton.index("left_hand"))].position);
  const std::uint8_t* pixel = boned.pixel(int(std::lround(hand.x())), int(std::lround(hand.y())));
  CHECK(int(pixel[2]) == int(kLeft.b));
  look.skeleton = false;
  look.weights_of = character.skeleton.index("head");
  CHECK(difference(seen(look), bare) > 1);
  // Without body and ground there is only what is behind them.
  look = Look();
  look.solid = false;
  look.background = kClear;
  CHECK(covered(seen(look)) == 0);
  look.picture = Image(3, 2);
  look.picture.rgba.setConstant(255);
  CHECK(covered(seen(look)) == 160 * 160);
}

TEST_CASE("wires leave the body's colours to be seen, however fine they lie in the picture") {
  const RiggedCharacter character = figure();
  const Scene scene(character, softwarePainter(character.mesh));
  const JointTransforms rest(character.skeleton.joints.size(), Eigen::Affine3f::Identity());
  const Camera camera = framingCamera(character.mesh.vertices, 0, 0.2);
  for (const int side : {60, 160, 480}) {
    Look look;
    look.shadow = false;
    look.background = kClear;
    const Image bare = scene.paint(rest, camera, side, side, look);
    look.wireframe = true;
    const double on_body = difference(scene.paint(rest, camera, side, side, look), bare) * side * side;
    CAPTURE(side);
    CHECK(on_body / covered(bare) > 2);
    CHECK(on_body / covered(bare) < 15);
  }
}

TEST_CASE("the back wears its own part of the texture, in every painter") {
  // A pillow: black in front, white behind.
  TriangleMesh mesh = square();
  mesh.vertices.conservativeResize(6, 3);
  mesh.vertices.bottomRows(2) << 0, 0.5f, 0.2f, 0, 0.5f, -0.2f;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5;
  mesh.uv.setConstant(6, 2, 0.25f);
  mesh.back_uv = mesh.uv;
  mesh.back_uv.col(0).setConstant(0.75f);
  mesh.first_back = 4;
  Surface surface;
  surface.shading = 0;
  for (const auto& [name, painter] : painters(mesh)) {
    CAPTURE(name);
    for (const bool behind : {false, true}) {
      Camera camera;
      camera.target = {0, 0.5, 0};
      camera.yaw_rad = behind ? std::numbers::pi : 0;
      const Image image = painter->paint(mesh.vertices, camera, 40, 40, surface);
      CHECK(int(image.pixel(18, 21)[0]) == (behind ? 255 : 0));
    }
  }
}
