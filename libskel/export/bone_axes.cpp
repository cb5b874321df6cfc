#include "libskel/export/bone_axes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "libskel/animation/bone_turn.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond withUpAlong(const Vector3d& direction) {
  const Vector3d y = direction.normalized();
  const Vector3d side = std::abs(y.z()) < .9 ? Vector3d::UnitZ() : Vector3d::UnitY();
  const Vector3d z = (side - side.dot(y) * y).normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return Quaterniond(axes);
}

bool stretchesUnevenly(const JointTrack& track) {
  return std::any_of(track.scales.begin(), track.scales.end(), [](const Eigen::Vector3f& s) {
    return s.maxCoeff() - s.minCoeff() > 1e-4f * s.cwiseAbs().maxCoeff();
  });
}

}  // namespace

MovedVertices::MovedVertices(const TriangleMesh& mesh, const SkinWeights& skin, const Skeleton& skeleton)
    : bones(restBones(skeleton)),
      places(Eigen::Matrix3Xd::Zero(3, Eigen::Index(skeleton.joints.size()))),
      any(skeleton.joints.size(), false),
      most(skeleton.joints.size()) {
  std::vector<double> all(any.size(), 0);
  for (Eigen::Index v = 0; v < skin.weights.rows(); ++v) {
    most[skin.joints(v, 0)].push_back(int(v));
    for (int k = 0; k < skin.weights.cols(); ++k) {
      const int joint = skin.joints(v, k);
      places.col(joint) += double(skin.weights(v, k)) * mesh.vertices.row(v).transpose().cast<double>();
      all[std::size_t(joint)] += skin.weights(v, k);
    }
  }
  for (std::size_t j = 0; j < any.size(); ++j)
    if ((any[j] = all[j] != 0)) places.col(Eigen::Index(j)) /= all[j];
  if (mesh.vertices.rows() > 0) ground_m = double(mesh.vertices.col(1).minCoeff());
}

bool isLeaf(const Skeleton& skeleton, int joint) {
  return std::none_of(skeleton.joints.begin(), skeleton.joints.end(),
                      [&](const Joint& other) { return other.parent == joint; });
}

Vector3d boneDirection(const Skeleton& skeleton, int index, const MovedVertices& moved) {
  const Joint& joint = skeleton.joints[std::size_t(index)];
  const Vector3d on = moved.bones[std::size_t(index)];
  if (!isLeaf(skeleton, index)) return on;
  const Vector3d bone = joint.tail ? (*joint.tail - joint.position).normalized() : on;
  if (joint.parent < 0) return bone;
  // As long as its parent's is how programs draw a bone without a child.
  const double length = (joint.position - skeleton.joints[std::size_t(joint.parent)].position).norm();
  if (joint.position.y() + length * bone.y() >= moved.ground_m) return bone;
  if (moved.any[std::size_t(index)]) {
    const Vector3d reach = moved.places.col(index) - joint.position;
    const Vector3d along_ground(reach.x(), 0, reach.z());
    if (along_ground.norm() > .1 * length) return along_ground;
  }
  return Vector3d::UnitZ();
}

std::vector<Quaterniond> boneAxes(const Skeleton& skeleton, const TriangleMesh& mesh, const SkinWeights& skin,
                                  const std::vector<Clip>& clips) {
  std::unordered_set<std::string> stretched;
  for (const Clip& clip : clips)
    for (const JointTrack& track : clip.tracks)
      if (stretchesUnevenly(track)) stretched.insert(track.joint);
  const MovedVertices moved(mesh, skin, skeleton);
  std::vector<Quaterniond> axes;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    axes.push_back(stretched.contains(skeleton.joints[j].name)
                       ? Quaterniond::Identity()
                       : withUpAlong(boneDirection(skeleton, int(j), moved)));
  }
  return axes;
}

}  // namespace skel
