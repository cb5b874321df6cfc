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
