#include "libskel/export/bone_ends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <vector>

#include "libskel/export/bone_axes.h"

namespace skel {
namespace {

using Eigen::Vector3d;

constexpr double kFarEnd = .2;     // the share of its length that tells where the middle of the end is
constexpr double kShortest = .05;  // of its parent's bone
constexpr double kUsual = .4;      // the same: as long as most hands are

std::optional<Vector3d> boneEnd(const Skeleton& skeleton, int index, const TriangleMesh& mesh,
                                const MovedVertices& by_joint) {
  const Joint& joint = skeleton.joints[std::size_t(index)];
  if (joint.tail) return joint.tail;
  if (joint.parent < 0) return std::nullopt;
  const Vector3d direction = boneDirection(skeleton, index, by_joint).normalized();
  std::vector<Vector3d> moved;  // from the joint
  double length = 0;
  for (const int v : by_joint.most[std::size_t(index)]) {
    moved.push_back(mesh.vertices.row(v).transpose().cast<double>() - joint.position);
    length = std::max(length, moved.back().dot(direction));
  }
  const double before = (joint.position - skeleton.joints[std::size_t(joint.parent)].position).norm();
  if (length <= kShortest * before) {
    if (!by_joint.any[std::size_t(index)]) return std::nullopt;
    Vector3d tip = joint.position + kUsual * before * direction;
    tip.y() = std::max(tip.y(), std::min(joint.position.y(), by_joint.ground_m));
    return tip;
  }
  Eigen::AlignedBox3d end;
  for (const Vector3d& from_joint : moved)
    if (from_joint.dot(direction) >= (1 - kFarEnd) * length) end.extend(from_joint);
  const Vector3d aside = end.center() - end.center().dot(direction) * direction;
  // What is as wide as long (the top of a head) says nothing about where its bone leads.
  Vector3d tip = length * direction + (aside.norm() < .5 * length ? aside : Vector3d::Zero());
  tip.y() = std::max(tip.y(), end.min().y());  // a foot that is drawn aslant stays above the ground
  return joint.position + tip;
}

}  // namespace

std::string boneEndName(const std::string& joint) { return joint + "_end"; }

Skeleton withBoneEnds(const Skeleton& skeleton, const TriangleMesh& mesh, const SkinWeights& skin) {
  Skeleton result = skeleton;
  const MovedVertices by_joint(mesh, skin, skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::string name = boneEndName(skeleton.joints[j].name);
    if (!isLeaf(skeleton, int(j)) || skeleton.find(name) >= 0) continue;
    const std::optional<Vector3d> position = boneEnd(skeleton, int(j), mesh, by_joint);
    if (!position) continue;
    Joint end;
    end.name = name;
    end.parent = int(j);
    end.position = *position;
    end.origin = JointOrigin::kDerived;
    result.joints.push_back(end);
  }
  return result;
}

}  // namespace skel
