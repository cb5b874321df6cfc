#include "libskel/deform/bound_stretch.h"

#include <numbers>

#include "libskel/animation/sample_pose.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/deform/stretch.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

constexpr int kColumns = 60, kRows = 6;
constexpr float kEdge_m = 0.02f;

// A sheet of so many squares.
TriangleMesh sheet(int columns, int rows) {
  TriangleMesh mesh;
  mesh.vertices.resize((columns + 1) * (rows + 1), 3);
  for (int x = 0; x <= columns; ++x)
    for (int y = 0; y <= rows; ++y)
      mesh.vertices.row(x * (rows + 1) + y) << kEdge_m * float(x), kEdge_m * float(y - rows / 2), 0;
  mesh.triangles.resize(2 * columns * rows, 3);
  Eigen::Index t = 0;
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < rows; ++y) {
      const int a = x * (rows + 1) + y, b = a + rows + 1;
      mesh.triangles.row(t++) << a, b, b + 1;
      mesh.triangles.row(t++) << a, b + 1, a + 1;
    }
  return mesh;
}

// A band along x, an arm on a trunk: "neck" moves what lies left of the shoulder, the arm the rest.
TriangleMesh band() { return sheet(kColumns, kRows); }

// The band, and far from it a trunk so large that what the arm tears is little.
TriangleMesh bandBesideTrunk() {
  const TriangleMesh arm = band(), trunk = sheet(100, 100);
  TriangleMesh mesh;
  mesh.vertices.resize(arm.vertices.rows() + trunk.vertices.rows(), 3);
  mesh.vertices << arm.vertices, trunk.vertices.rowwise() - Eigen::RowVector3f(10, 0, 0);
  mesh.triangles.resize(arm.triangles.rows() + trunk.triangles.rows(), 3);
  mesh.triangles << arm.triangles, trunk.triangles.array() + int(arm.vertices.rows());
  return mesh;
}

Skeleton armOnTrunk() {
  Skeleton skeleton;
  const auto add = [&](const char* name, int parent, double x) {
    Joint joint{name};
    joint.parent = parent;
    joint.position = {x, 0, 0};
    skeleton.joints.push_back(joint);
  };
  add("pelvis", -1, 0);
  add("neck", 0, 0.1);
  add("head", 1, 0.05);
  add("left_shoulder", 1, 0.4);
  add("left_elbow", 3, 0.7);
  add("left_hand", 4, 1);
  return skeleton;
}

SkinWeights weightsOf(const TriangleMesh& mesh, int (*joint)(float x)) {
  SkinWeights weights;
  weights.joints.setZero(mesh.vertices.rows(), 4);
  weights.weights.setZero(mesh.vertices.rows(), 4);
  weights.weights.col(0).setOnes();
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    weights.joints(v, 0) = std::uint16_t(joint(mesh.vertices(v, 0)));
  return weights;
}

Clip lift(const char* joint, double degrees) {
  Clip clip;
  clip.name = "lift";
  JointTrack track;
  track.joint = joint;
  track.times_s = {0, 1};
  track.rotations = {Eigen::Quaternionf::Identity(),
                     Eigen::Quaternionf(Eigen::AngleAxisf(float(degrees * std::numbers::pi / 180),
                                                          Eigen::Vector3f::UnitZ()))};
  clip.tracks = {track};
  return clip;
}

double mostStretched(const TriangleMesh& mesh, const Skeleton& skeleton, const SkinWeights& weights,
                     const Clip& clip) {
  double most = 0;
  for (const float time_s : {0.1f, 0.35f, 0.6f, 0.85f, 1.f}) {
    const Eigen::MatrixX3f posed =
        skinVertices(mesh.vertices, weights, posedFromRest(skeleton, samplePose(clip, skeleton, time_s), 1));
    for (const RestTriangle& t : restTriangles(mesh)) most = std::max(most, stretchOf(t, mesh, posed));
  }
  return most;
}

const std::vector<double> kFree(6, 0);

int atJoint(float x) { return x < 0.4f ? 1 : x < 0.7f ? 3 : 4; }

}  // namespace

TEST_CASE("a vertex that hangs on another limb is drawn out to a needle no more") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  SkinWeights weights = weightsOf(mesh, [](float) { return 1; });
  const Eigen::Index needle = 10 * (kRows + 1) + 3;
  weights.joints(needle, 0) = 4;
  const SkinWeights before = weights;
  const Clip clip = lift("left_shoulder", 60);
  REQUIRE(mostStretched(mesh, skeleton, weights, clip) > 10);
  CHECK(boundStretch(mesh, skeleton, kFree, {clip}, weights).stretched == 0);
  CHECK(mostStretched(mesh, skeleton, weights, clip) < kMostStretch);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    CHECK(weights.weights.row(v).sum() == Approx(1));
    // What is far from it stays as it was.
    if (std::abs(mesh.vertices(v, 0) - mesh.vertices(needle, 0)) > 0.3f) {
      CHECK(weights.joints.row(v) == before.joints.row(v));
      CHECK(weights.weights.row(v) == before.weights.row(v));
    }
  }
}

TEST_CASE("weights that change at once over one edge change over as much as the bend needs") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  SkinWeights weights = weightsOf(mesh, atJoint);
  const Clip clip = lift("left_elbow", 120);
  REQUIRE(mostStretched(mesh, skeleton, weights, clip) > kMostStretch);
  CHECK(boundStretch(mesh, skeleton, kFree, {clip}, weights).stretched == 0);
  CHECK(mostStretched(mesh, skeleton, weights, clip) < kMostStretch);
  // The ends still are what they were.
  CHECK(weights.weights(0, 0) == 1);
  CHECK(weights.joints(mesh.vertices.rows() - 1, 0) == 4);
}

TEST_CASE("an arm that is grown to the body or tears much rides with it, a free one keeps moving") {
  const Skeleton skeleton = armOnTrunk();
  const Clip clip = lift("left_shoulder", 170);
  struct Bound {
    bool held;
    float of_arm;  // sum of its weights
    double stretch;
  };
  const auto bound = [&](const TriangleMesh& mesh, const std::vector<double>& joined) {
    // The band's far end is the body's, too: trunk, arm, trunk.
    SkinWeights weights = weightsOf(mesh, [](float x) { return x > 0.4f && x < 0.6f ? 3 : 1; });
    const bool held = boundStretch(mesh, skeleton, joined, {clip}, weights).held_arms;
    float sum = 0;
    for (Eigen::Index v = 0; v < weights.weights.rows(); ++v)
      for (int k = 0; k < 4; ++k) sum += weights.joints(v, k) == 3 ? weights.weights(v, k) : 0;
    return Bound{held, sum, mostStretched(mesh, skeleton, weights, clip)};
  };
  for (const Bound& rides : {bound(bandBesideTrunk(), {0, 0, 0, 1, 1, 1}), bound(band(), kFree)}) {
    CHECK(rides.held);
    CHECK(rides.of_arm == 0);
    CHECK(rides.stretch < kMostStretch);
  }
  const Bound moves = bound(bandBesideTrunk(), kFree);
  CHECK_FALSE(moves.held);
  CHECK(moves.of_arm > 10);
}

TEST_CASE("what nothing stretches stays bit by bit") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  SkinWeights weights = weightsOf(mesh, atJoint);
  const SkinWeights before = weights;
  CHECK(boundStretch(mesh, skeleton, kFree, {lift("left_shoulder", 3)}, weights).stretched == 0);
  CHECK(boundStretch(mesh, skeleton, kFree, {}, weights).stretched == 0);
  CHECK(weights.joints == before.joints);
  CHECK(weights.weights == before.weights);
}
