#include "libskel/export/bone_axes.h"

#include <algorithm>
#include <cmath>

#include "libskel/animation/retarget.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// How far the vertices that a joint moves lie from it on the whole, along the ground, m.
Vector3d reachOnGround(const Eigen::MatrixX3f& vertices, const SkinWeights& skin, int joint,
                       const Vector3d& from) {
  Vector3d sum = Vector3d::Zero();
  double all = 0;
  for (Eigen::Index v = 0; v < skin.weights.rows(); ++v) {
    for (int k = 0; k < skin.weights.cols(); ++k) {
      if (skin.joints(v, k) != joint) continue;
      sum += double(skin.weights(v, k)) * vertices.row(v).transpose().cast<double>();
      all += skin.weights(v, k);
    }
  }
  if (all == 0) return Vector3d::Zero();
  const Vector3d reach = sum / all - from;
  return {reach.x(), 0, reach.z()};
}

Quaterniond withUpAlong(const Vector3d& direction) {
  const Vector3d y = direction.normalized();
  const Vector3d side = std::abs(y.z()) < .9 ? Vector3d::UnitZ() : Vector3d::UnitY();
  const Vector3d z = (side - side.dot(y) * y).normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return Quaterniond(axes);
}

bool stretchesUnevenly(const Clip& clip, const std::string& joint) {
  return std::any_of(clip.tracks.begin(), clip.tracks.end(), [&](const JointTrack& track) {
    return track.joint == joint &&
           std::any_of(track.scales.begin(), track.scales.end(), [](const Eigen::Vector3f& s) {
             return s.maxCoeff() - s.minCoeff() > 1e-4f * s.cwiseAbs().maxCoeff();
           });
  });
}

}  // namespace

std::vector<Quaterniond> boneAxes(const Skeleton& skeleton, const TriangleMesh& mesh, const SkinWeights& skin,
                                  const std::vector<Clip>& clips) {
  const std::vector<Joint>& joints = skeleton.joints;
  const double ground = mesh.vertices.col(1).minCoeff();
  std::vector<bool> leaf(joints.size(), true);
  for (const Joint& joint : joints)
    if (joint.parent >= 0) leaf[std::size_t(joint.parent)] = false;
  std::vector<Quaterniond> axes;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    Vector3d bone = restBone(skeleton, int(j));
    if (leaf[j] && joint.tail) bone = (*joint.tail - joint.position).normalized();
    if (leaf[j] && joint.parent >= 0) {
      // As long as its parent's is how programs draw a bone without a child.
      const double length = (joint.position - joints[std::size_t(joint.parent)].position).norm();
      if (joint.position.y() + length * bone.y() < ground) {
        const Vector3d reach = reachOnGround(mesh.vertices, skin, int(j), joint.position);
        bone = reach.norm() > .1 * length ? reach : Vector3d::UnitZ();
      }
    }
    const bool stretched = std::any_of(clips.begin(), clips.end(),
                                       [&](const Clip& clip) { return stretchesUnevenly(clip, joint.name); });
    axes.push_back(stretched ? Quaterniond::Identity() : withUpAlong(bone));
  }
  return axes;
}

}  // namespace skel
