// L. Kavan, S. Collins, J. Žára, C. O'Sullivan, "Geometric skinning with approximate dual quaternion
// blending" (2008): algorithm 1, and for joints that scale the two phases of section 5.
#include "libskel/deform/dual_quaternions.h"

#include <Eigen/SVD>

namespace skel {
namespace {

// As vectors (x, y, z, w), so that they can be summed.
struct DualQuaternion {
  Eigen::Vector4f real, dual;
};

struct Motion {
  DualQuaternion rigid;
  Eigen::Matrix3f stretch;  // before the rigid motion, about the model's origin
};

std::vector<Motion> motionsOf(const JointTransforms& transforms, bool& stretched) {
  std::vector<Motion> motions;
  stretched = false;
  for (const Eigen::Affine3f& transform : transforms) {
    const Eigen::Matrix3f linear = transform.linear();
    Motion motion;
    motion.stretch.setIdentity();
    Eigen::Matrix3f rotation = linear;
    if (!(linear * linear.transpose()).isIdentity(1e-5f) || linear.determinant() < 0) {
      transform.computeRotationScaling(&rotation, &motion.stretch);
      stretched = true;
    }
    const Eigen::Quaternionf real(rotation);
    const Eigen::Vector3f t = transform.translation();
    const Eigen::Quaternionf dual = Eigen::Quaternionf(0, t.x(), t.y(), t.z()) * real;
    motion.rigid = {real.coeffs(), 0.5f * dual.coeffs()};
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace

Eigen::MatrixX3f blendDualQuaternions(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                                      const JointTransforms& posed_from_rest) {
  bool stretched = false;
  const std::vector<Motion> motions = motionsOf(posed_from_rest, stretched);
  Eigen::MatrixX3f result(vertices.rows(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const DualQuaternion& first = motions[weights.joints(v, 0)].rigid;
    DualQuaternion sum{Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero()};
    Eigen::Matrix3f stretch = Eigen::Matrix3f::Zero();
    for (int k = 0; k < 4; ++k) {
      const float weight = weights.weights(v, k);
      if (weight <= 0) continue;
      const Motion& motion = motions[weights.joints(v, k)];
      // q and −q are the same turn: the shorter way between two.
      const float share = motion.rigid.real.dot(first.real) < 0 ? -weight : weight;
      sum.real += share * motion.rigid.real;
      sum.dual += share * motion.rigid.dual;
      if (stretched) stretch += weight * motion.stretch;
    }
    Eigen::Vector3f p = vertices.row(v);
    if (stretched) p = stretch * p;
    const float length = sum.real.norm();
    const Eigen::Vector3f turn = sum.real.head<3>() / length, shift = sum.dual.head<3>() / length;
    const float w = sum.real[3] / length, shift_w = sum.dual[3] / length;
    result.row(v) =
        p + 2 * turn.cross(turn.cross(p) + w * p) + 2 * (w * shift - shift_w * turn + turn.cross(shift));
  }
  return result;
}

}  // namespace skel
