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

bool isLeaf(const Skeleton& skeleton, int joint) {
  return std::none_of(skeleton.joints.begin(), skeleton.joints.end(),
                      [&](const Joint& other) { return other.parent == joint; });
}

Vector3d boneDirection(const Skeleton& skeleton, int index, const TriangleMesh& mesh,
                       const SkinWeights& skin) {
  const Joint& joint = skeleton.joints[std::size_t(index)];
  const Vector3d on = restBone(skeleton, index);
  if (!isLeaf(skeleton, index)) return on;
  const Vector3d bone = joint.tail ? (*joint.tail - joint.position).normalized() : on;
  if (joint.parent < 0) return bone;
  // As long as its parent's is how programs draw a bone without a child.
  const double length = (joint.position - skeleton.joints[std::size_t(joint.parent)].position).norm();
  if (joint.position.y() + length * bone.y() >= double(mesh.vertices.col(1).minCoeff())) return bone;
  const Vector3d reach = reachOnGround(mesh.vertices, skin, index, joint.position);
  if (reach.norm() > .1 * length) return reach;
  return Vector3d::UnitZ();
}

std::vector<Quaterniond> boneAxes(const Skeleton& skeleton, const TriangleMesh& mesh, const SkinWeights& skin,
                                  const std::vector<Clip>& clips) {
  std::vector<Quaterniond> axes;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::string& name = skeleton.joints[j].name;
    const bool stretched = std::any_of(clips.begin(), clips.end(),
                                       [&](const Clip& clip) { return stretchesUnevenly(clip, name); });
    axes.push_back(stretched ? Quaterniond::Identity()
                             : withUpAlong(boneDirection(skeleton, int(j), mesh, skin)));
  }
  return axes;
}

}  // namespace skel
