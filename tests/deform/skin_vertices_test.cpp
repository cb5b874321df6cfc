#include "libskel/deform/skin_vertices.h"

#include <numbers>

#include "tests/support/catch.h"

using namespace skel;

namespace {

Skeleton chain() {
  Skeleton skeleton;
  for (int j = 0; j < 3; ++j) {
    Joint joint;
    joint.name = std::to_string(j);
    joint.parent = j - 1;
    joint.position = {double(j), 1, 0};
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

SkinWeights bind(std::vector<std::array<float, 3>> rows) {
  SkinWeights weights;
  weights.joints.setZero(static_cast<Eigen::Index>(rows.size()), 4);
  weights.weights.setZero(static_cast<Eigen::Index>(rows.size()), 4);
  for (std::size_t v = 0; v < rows.size(); ++v) {
    for (int j = 0; j < 3; ++j) {
      weights.joints(static_cast<Eigen::Index>(v), j) = static_cast<std::uint16_t>(j);
      weights.weights(static_cast<Eigen::Index>(v), j) = rows[v][j];
    }
  }
  return weights;
}

}  // namespace

TEST_CASE("the rest pose leaves everything in its place") {
  const JointTransforms rest =
      posedFromRest(chain(), std::vector<Eigen::Quaternionf>(3, Eigen::Quaternionf::Identity()));
  Eigen::MatrixX3f vertices = Eigen::MatrixX3f::Random(5, 3);
  const SkinWeights weights = bind({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0}, {0.25f, 0.5f, 0.25f}});
  CHECK((skinVertices(vertices, weights, rest) - vertices).cwiseAbs().maxCoeff() < 1e-6f);
}

TEST_CASE("a joint turns what lies below it about itself, on top of its parent's turn") {
  const Eigen::Quaternionf quarter(
      Eigen::AngleAxisf(0.5f * std::numbers::pi_v<float>, Eigen::Vector3f::UnitZ()));
  const JointTransforms posed =
      posedFromRest(chain(), {Eigen::Quaternionf::Identity(), quarter, quarter}, Eigen::Vector3f(0, 0, 5));
  const std::vector<Eigen::Vector3f> joints = posedJoints(chain(), posed);
  CHECK((joints[0] - Eigen::Vector3f(0, 1, 5)).norm() < 1e-6f);
  CHECK((joints[1] - Eigen::Vector3f(1, 1, 5)).norm() < 1e-6f);
  CHECK((joints[2] - Eigen::Vector3f(1, 2, 5)).norm() < 1e-6f);

  Eigen::MatrixX3f vertices(3, 3);
  vertices << 3, 1, 0, 2, 1, 0, 2, 1, 0;
  const Eigen::MatrixX3f result =
      skinVertices(vertices, bind({{0, 0, 1}, {0, 1, 0}, {0.5f, 0.5f, 0}}), posed);
  CHECK((result.row(0) - Eigen::RowVector3f(0, 2, 5)).norm() < 1e-5f);
  CHECK((result.row(1) - Eigen::RowVector3f(1, 2, 5)).norm() < 1e-5f);
  CHECK((result.row(2) - Eigen::RowVector3f(1.5f, 1.5f, 5)).norm() < 1e-5f);
}

TEST_CASE("a pose moves, turns and scales, in this order as seen from the parent") {
  Pose pose;
  pose.rotations.assign(3, Eigen::Quaternionf::Identity());
  pose.root_translation = {0, 0, 1};
  const auto with = [](const Pose& of) { return posedFromRest(chain(), of, 5); };
  CHECK(with(pose)[2].isApprox(posedFromRest(chain(), pose.rotations, {0, 0, 5})[2]));

  pose.rotations[1] =
      Eigen::Quaternionf(Eigen::AngleAxisf(0.5f * std::numbers::pi_v<float>, Eigen::Vector3f::UnitZ()));
  pose.translations_m.assign(3, Eigen::Vector3f::Zero());
  pose.translations_m[1] = {0, 3, 0};
  pose.scales.assign(3, Eigen::Vector3f::Ones());
  pose.scales[1] = {2, 1, 1};
  const std::vector<Eigen::Vector3f> joints = posedJoints(chain(), with(pose));
  CHECK((joints[0] - Eigen::Vector3f(0, 1, 5)).norm() < 1e-6f);
  CHECK((joints[1] - Eigen::Vector3f(1, 4, 5)).norm() < 1e-6f);
  // The bone, twice as long, points up.
  CHECK((joints[2] - Eigen::Vector3f(1, 6, 5)).norm() < 1e-6f);
}

namespace {

// A tube about the x axis, bound half to each of two joints at its middle.
struct Tube {
  Skeleton skeleton = chain();
  Eigen::MatrixX3f vertices{8, 3};
  SkinWeights weights = bind(std::vector<std::array<float, 3>>(8, {0, 0.5f, 0.5f}));

  Tube() {
    for (int k = 0; k < 8; ++k) {
      const float angle = 0.25f * std::numbers::pi_v<float> * static_cast<float>(k);
      vertices.row(k) << 2, 1 + 0.3f * std::cos(angle), 0.3f * std::sin(angle);
    }
  }
};

JointTransforms turned(const Skeleton& skeleton, int joint, float angle, const Eigen::Vector3f& axis) {
  std::vector<Eigen::Quaternionf> rotations(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  rotations[static_cast<std::size_t>(joint)] = Eigen::AngleAxisf(angle, axis);
  return posedFromRest(skeleton, rotations);
}

}  // namespace

TEST_CASE("a twist half way between two joints: matrices make the tube thinner, dual quaternions do not") {
  const Tube tube;
  const JointTransforms posed =
      turned(tube.skeleton, 2, 0.5f * std::numbers::pi_v<float>, Eigen::Vector3f::UnitX());
  const auto radius = [&](Blending blending) {
    const Eigen::MatrixX3f result = skinVertices(tube.vertices, tube.weights, posed, blending);
    return (result.row(3) - Eigen::RowVector3f(2, 1, 0)).norm();
  };
  CHECK(radius(Blending::kLinear) == Approx(0.3f * std::cos(0.25f * std::numbers::pi_v<float>)));
  CHECK(radius(Blending::kDualQuaternions) == Approx(0.3f));
  // Each point by half the angle about the axis.
  const Eigen::MatrixX3f result =
      skinVertices(tube.vertices, tube.weights, posed, Blending::kDualQuaternions);
  for (int k = 0; k < 8; ++k) CHECK((result.row(k) - tube.vertices.row((k + 1) % 8)).norm() < 1e-6f);
}

TEST_CASE("both ways of blending agree where there is nothing to blend, and where everything moves alike") {
  const Eigen::MatrixX3f vertices = Eigen::MatrixX3f::Random(6, 3);
  const SkinWeights whole = bind({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const SkinWeights mixed = bind(std::vector<std::array<float, 3>>(6, {0.25f, 0.5f, 0.25f}));
  const Skeleton skeleton = chain();
  const Eigen::Vector3f axis = Eigen::Vector3f(1, 2, 3).normalized();
  for (const float angle : {0.0f, 0.7f, 3.0f, -2.5f}) {
    const JointTransforms one = turned(skeleton, 1, angle, axis), all = turned(skeleton, 0, angle, axis);
    CHECK(
        (skinVertices(vertices, whole, one, Blending::kDualQuaternions) - skinVertices(vertices, whole, one))
            .cwiseAbs()
            .maxCoeff() < 2e-6f);
    CHECK(
        (skinVertices(vertices, mixed, all, Blending::kDualQuaternions) - skinVertices(vertices, mixed, all))
            .cwiseAbs()
            .maxCoeff() < 2e-6f);
  }
  JointTransforms scaled = turned(skeleton, 1, 0.5f, axis);
  for (Eigen::Affine3f& transform : scaled) transform = transform * Eigen::Scaling(1.0f, 2.0f, 0.5f);
  CHECK((skinVertices(vertices, whole, scaled, Blending::kDualQuaternions) -
         skinVertices(vertices, whole, scaled))
            .cwiseAbs()
            .maxCoeff() < 5e-6f);
}

TEST_CASE("a mirrored model in a mirrored pose is the mirror image") {
  const Tube tube;
  Skeleton mirrored = tube.skeleton;
  for (Joint& joint : mirrored.joints) joint.position.x() *= -1;
  Eigen::MatrixX3f vertices = tube.vertices;
  vertices.col(0) *= -1;
  const Eigen::Vector3f axis = Eigen::Vector3f(1, 2, 3).normalized();
  const Eigen::Vector3f mirrored_axis(axis.x(), -axis.y(), -axis.z());  // a turn's axis is no plain vector
  for (const Blending blending : {Blending::kLinear, Blending::kDualQuaternions}) {
    Eigen::MatrixX3f a =
        skinVertices(tube.vertices, tube.weights, turned(tube.skeleton, 1, 0.8f, axis), blending);
    a.col(0) *= -1;
    const Eigen::MatrixX3f b =
        skinVertices(vertices, tube.weights, turned(mirrored, 1, 0.8f, mirrored_axis), blending);
    CHECK((a - b).cwiseAbs().maxCoeff() < 2e-6f);
  }
}
