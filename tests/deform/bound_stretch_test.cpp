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

// A band along x, an arm on a trunk: "neck" moves what lies left of the shoulder, the arm the rest.
TriangleMesh band() {
  TriangleMesh mesh;
  mesh.vertices.resize((kColumns + 1) * (kRows + 1), 3);
  for (int x = 0; x <= kColumns; ++x)
    for (int y = 0; y <= kRows; ++y)
      mesh.vertices.row(x * (kRows + 1) + y) << kEdge_m * float(x), kEdge_m * float(y - kRows / 2), 0;
  mesh.triangles.resize(2 * kColumns * kRows, 3);
  Eigen::Index t = 0;
  for (int x = 0; x < kColumns; ++x)
    for (int y = 0; y < kRows; ++y) {
      const int a = x * (kRows + 1) + y, b = a + kRows + 1;
      mesh.triangles.row(t++) << a, b, b + 1;
      mesh.triangles.row(t++) << a, b + 1, a + 1;
    }
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

int atJoint(float x) { return x < 0.4f ? 1 : x < 0.7f ? 3 : 4; }

}  // namespace

TEST_CASE("a vertex that hangs on another limb is drawn out to a needle no more") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  SkinWeights weights = weightsOf(mesh, atJoint);
  const Eigen::Index needle = 10 * (kRows + 1) + 3;
  weights.joints(needle, 0) = 4;
  const SkinWeights before = weights;
  const Clip clip = lift("left_shoulder", 25);
  REQUIRE(mostStretched(mesh, skeleton, weights, clip) > 3);
  CHECK(boundStretch(mesh, skeleton, {clip}, 4, weights).stretched == 0);
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
  CHECK(boundStretch(mesh, skeleton, {clip}, 4, weights).stretched == 0);
  CHECK(mostStretched(mesh, skeleton, weights, clip) < kMostStretch);
  // The ends still are what they were.
  CHECK(weights.weights(0, 0) == 1);
  CHECK(weights.joints(mesh.vertices.rows() - 1, 0) == 4);
}

TEST_CASE("an arm that would take the body along is uprooted, one that gives little keeps moving") {
  const Skeleton skeleton = armOnTrunk();
  const TriangleMesh mesh = band();
  const Clip clip = lift("left_shoulder", 170);
  // The band's far end is the body's, too.
  SkinWeights grown = weightsOf(mesh, [](float x) { return x > 0.4f && x < 0.6f ? 3 : 1; });
  const SkinWeights before = grown;
  const StretchBound bound = boundStretch(mesh, skeleton, {clip}, 4, grown);
  REQUIRE(bound.uprooted.size() == 1);
  CHECK(skeleton.joints[std::size_t(bound.uprooted[0].hand)].name == "left_hand");
  CHECK(bound.uprooted[0].layer == 0);
  CHECK(grown.joints == before.joints);
  CHECK(grown.weights == before.weights);
  holdArm(mesh, skeleton, bound.uprooted[0], grown);
  CHECK(grown.joints.col(0).isConstant(1));
  CHECK(grown.weights.col(0).isOnes());
  CHECK(boundStretch(mesh, skeleton, {clip}, 4, grown).uprooted.empty());

  SkinWeights free = weightsOf(mesh, [](float x) { return x > 0.4f ? 3 : 1; });
  const StretchBound gives = boundStretch(mesh, skeleton, {clip}, 4, free);
  CHECK(gives.uprooted.empty());
  CHECK(gives.stretched == 0);
  CHECK(mostStretched(mesh, skeleton, free, clip) < kMostStretch);
}

TEST_CASE("an arm is held in one body of the mesh alone") {
  TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  mesh.layer = (mesh.vertices.col(0).array() > 0.8f).cast<int>();
  SkinWeights weights = weightsOf(mesh, atJoint);
  holdArm(mesh, skeleton, {skeleton.find("left_hand"), 0}, weights);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    CHECK(weights.joints(v, 0) == (mesh.layer[v] == 0 ? 1 : 4));
}

TEST_CASE("no vertex gets more joints than asked for") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  const std::vector<Clip> clips = {lift("left_shoulder", 100), lift("left_elbow", 120)};
  const int most = GENERATE(1, 2, 3);
  CAPTURE(most);
  SkinWeights weights = weightsOf(mesh, [](float x) { return x < 0.4f ? 1 : x < 0.46f ? 3 : 4; });
  const SkinWeights before = weights;
  boundStretch(mesh, skeleton, clips, most, weights);
  CHECK((weights.weights.array() > 0).rowwise().count().maxCoeff() == most);
  CHECK((weights.weights == before.weights) == (most == 1));
}

TEST_CASE("a vertex that five joints carry alike keeps four of them") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  // Two columns, each of which hangs on other joints, all alike; between them what both have is five.
  SkinWeights weights = weightsOf(mesh, atJoint);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    weights.weights.row(v).setConstant(0.25f);
    weights.joints.row(v) << 0, 1, std::uint16_t(v % 2 ? 3 : 2), std::uint16_t(v % 2 ? 4 : 5);
  }
  boundStretch(mesh, skeleton, {lift("left_shoulder", 170)}, 4, weights);
  CHECK(weights.weights.allFinite());
  CHECK((weights.weights.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-5f);
}

TEST_CASE("what nothing stretches stays bit by bit") {
  const TriangleMesh mesh = band();
  const Skeleton skeleton = armOnTrunk();
  SkinWeights weights = weightsOf(mesh, atJoint);
  const SkinWeights before = weights;
  CHECK(boundStretch(mesh, skeleton, {lift("left_shoulder", 3)}, 4, weights).stretched == 0);
  CHECK(boundStretch(mesh, skeleton, {}, 4, weights).stretched == 0);
  CHECK(weights.joints == before.joints);
  CHECK(weights.weights == before.weights);
}
