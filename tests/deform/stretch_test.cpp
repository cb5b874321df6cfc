#include "libskel/deform/stretch.h"

#include <Eigen/Geometry>

#include "tests/support/catch.h"

using namespace skel;

namespace {

// A square of four triangles around its middle, 1 m wide.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, .5f, .5f, 0;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
  return mesh;
}

}  // namespace

TEST_CASE("stretch is the largest factor by which a triangle's map lengthens anything") {
  const TriangleMesh mesh = square();
  Eigen::MatrixX3f posed = mesh.vertices;
  posed.col(0) *= 4;
  for (const RestTriangle& t : restTriangles(mesh)) {
    CHECK(stretchOf(t, mesh, posed) == Approx(4));
    CHECK(t.area == Approx(.25));
  }
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(1, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  posed = mesh.vertices * turn.transpose();
  for (const RestTriangle& t : restTriangles(mesh))
    CHECK(stretchOf(t, mesh, posed) == Approx(1).margin(1e-5));
  CHECK(restTriangles(mesh, 2).size() == 2);
}

TEST_CASE("a clip that pulls a corner off says so, by the joint that pulls") {
  const TriangleMesh mesh = square();
  Skeleton skeleton;
  Joint root{"root"}, corner{"corner"};
  corner.parent = 0;
  corner.position = {0, 0, 0};
  skeleton.joints = {root, corner};
  SkinWeights weights;
  weights.joints.setZero(5, 4);
  weights.weights.setZero(5, 4);
  weights.weights.col(0).setOnes();
  weights.joints(0, 0) = 1;  // one corner of the first and the last triangle
  Clip clip;
  clip.name = "pull";
  JointTrack track;
  track.joint = "corner";
  track.translation_times_s = {0, 1};
  track.translations_m = {{-9, -9, 0}, {-9, -9, 0}};
  clip.tracks = {track};
  Clip still;
  still.name = "still";
  still.least_duration_s = 1;
  const std::vector<ClipStretch> found = clipStretches(mesh, skeleton, weights, {clip, still});
  REQUIRE(found.size() == 2);
  CHECK(found[0].clip == "pull");
  CHECK(found[0].share > 0);
  CHECK(found[0].by_joint[1] > found[0].by_joint[0]);
  CHECK(found[0].by_joint[0] + found[0].by_joint[1] == Approx(found[0].share));
  CHECK(found[1].share == 0);
}
