// A skinned mesh in a pose: linear blend skinning, or dual quaternions.
//
// N. Magnenat-Thalmann, R. Laperrière, D. Thalmann, "Joint-dependent local deformations for hand animation
// and object grasping" (1988).
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "libskel/animation/sample_pose.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

using JointTransforms = std::vector<Eigen::Affine3f, Eigen::aligned_allocator<Eigen::Affine3f>>;

// Forward kinematics: for each joint what takes the rest pose's model frame to the posed one (the product of
// the joint's global transform and its inverse bind matrix). `rotations`: one a joint, local to the parent,
// identity: the rest pose. `root_translation_m` is added to the root's rest position.
JointTransforms posedFromRest(const Skeleton& skeleton, const std::vector<Eigen::Quaternionf>& rotations,
                              const Eigen::Vector3f& root_translation_m = Eigen::Vector3f::Zero());

// The same with all that a pose holds. `height_m`: the model's, in units of which the root moves.
JointTransforms posedFromRest(const Skeleton& skeleton, const Pose& pose, float height_m);

// Where the joints themselves come to lie, model frame, m.
std::vector<Eigen::Vector3f> posedJoints(const Skeleton& skeleton, const JointTransforms& posed_from_rest);

enum class Blending {
  kLinear,           // of matrices: bent elbows lose thickness, twisted ones collapse
  kDualQuaternions,  // of rigid motions: they keep it (dual_quaternions.h)
};

// #V×3.
Eigen::MatrixX3f skinVertices(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                              const JointTransforms& posed_from_rest, Blending blending = Blending::kLinear);

}  // namespace skel
