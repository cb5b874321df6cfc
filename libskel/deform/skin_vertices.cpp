#include "libskel/deform/skin_vertices.h"

#include "libskel/core/check.h"
#include "libskel/deform/dual_quaternions.h"

namespace skel {

JointTransforms posedFromRest(const Skeleton& skeleton, const std::vector<Eigen::Quaternionf>& rotations,
                              const Eigen::Vector3f& root_translation_m) {
  SKEL_CHECK_EQ(rotations.size(), skeleton.joints.size());
  JointTransforms transforms;
  transforms.reserve(rotations.size());
  for (std::size_t j = 0; j < rotations.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const Eigen::Vector3f rest = joint.position.cast<float>();
    // Rest rotations are the identity: a joint turns everything below it about its own rest position.
    Eigen::Affine3f local = Eigen::Translation3f(rest) * rotations[j] * Eigen::Translation3f(-rest);
    if (joint.parent < 0) local.pretranslate(root_translation_m);
    transforms.push_back(joint.parent < 0 ? local : transforms[joint.parent] * local);
  }
  return transforms;
}

JointTransforms posedFromRest(const Skeleton& skeleton, const Pose& pose, float height_m) {
  const Eigen::Vector3f root_translation_m = height_m * pose.root_translation;
  if (pose.translations_m.empty() && pose.scales.empty())
    return posedFromRest(skeleton, pose.rotations, root_translation_m);
  const std::size_t count = skeleton.joints.size();
  SKEL_CHECK_EQ(pose.rotations.size(), count);
  JointTransforms transforms;
  transforms.reserve(count);
  for (std::size_t j = 0; j < count; ++j) {
    const Joint& joint = skeleton.joints[j];
    const Eigen::Vector3f rest = joint.position.cast<float>();
    Eigen::Vector3f at = rest;
    if (joint.parent < 0) at += root_translation_m;
    if (!pose.translations_m.empty()) at += pose.translations_m[j];
    Eigen::Affine3f local = Eigen::Affine3f(Eigen::Translation3f(at) * pose.rotations[j]);
    if (!pose.scales.empty()) local.scale(pose.scales[j]);
    local.translate(-rest);
    transforms.push_back(joint.parent < 0 ? local : transforms[joint.parent] * local);
  }
  return transforms;
}

std::vector<Eigen::Vector3f> posedJoints(const Skeleton& skeleton, const JointTransforms& posed_from_rest) {
  SKEL_CHECK_EQ(posed_from_rest.size(), skeleton.joints.size());
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t j = 0; j < posed_from_rest.size(); ++j) {
    positions.push_back(posed_from_rest[j] * skeleton.joints[j].position.cast<float>());
  }
  return positions;
}

Eigen::MatrixX3f skinVertices(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                              const JointTransforms& posed_from_rest, Blending blending) {
  SKEL_CHECK_EQ(weights.joints.rows(), vertices.rows());
  if (blending == Blending::kDualQuaternions) return blendDualQuaternions(vertices, weights, posed_from_rest);
  Eigen::MatrixX3f result(vertices.rows(), 3);
  const Eigen::Index count = vertices.rows();
  for (Eigen::Index v = 0; v < count; ++v) {
    // Whole columns of 4×4 matrices, which fit a vector register each.
    Eigen::Vector4f columns[4];
    for (int k = 0; k < 4; ++k) {
      const float weight = weights.weights(v, k);
      if (k > 0 && weight <= 0) continue;
      const Eigen::Matrix4f& matrix = posed_from_rest[weights.joints(v, k)].matrix();
      for (int c = 0; c < 4; ++c) {
        if (k == 0) {
          columns[c] = weight * matrix.col(c);
        } else {
          columns[c] += weight * matrix.col(c);
        }
      }
    }
    const Eigen::Vector4f posed =
        columns[0] * vertices(v, 0) + columns[1] * vertices(v, 1) + columns[2] * vertices(v, 2) + columns[3];
    result(v, 0) = posed[0], result(v, 1) = posed[1], result(v, 2) = posed[2];
  }
  return result;
}

}  // namespace skel
