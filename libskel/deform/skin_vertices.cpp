#include "libskel/deform/skin_vertices.h"

#include "libskel/core/check.h"

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
                              const JointTransforms& posed_from_rest) {
  SKEL_CHECK_EQ(weights.joints.rows(), vertices.rows());
  Eigen::MatrixX3f result(vertices.rows(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    Eigen::Matrix<float, 3, 4> blended = Eigen::Matrix<float, 3, 4>::Zero();
    for (int k = 0; k < 4; ++k) {
      const float weight = weights.weights(v, k);
      if (weight > 0) blended += weight * posed_from_rest[weights.joints(v, k)].affine();
    }
    result.row(v) = blended * vertices.row(v).transpose().homogeneous();
  }
  return result;
}

}  // namespace skel
