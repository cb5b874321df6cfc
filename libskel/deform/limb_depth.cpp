#include "libskel/deform/limb_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libskel/core/check.h"

namespace skel {
namespace {

using LimbJoints = std::array<int, 3>;  // in the skeleton, from the trunk outwards

double shareOf(const SkinWeights& weights, Eigen::Index v, int joint) {
  double share = 0;
  for (int k = 0; k < 4; ++k)
    if (weights.joints(v, k) == joint) share += double(weights.weights(v, k));
  return share;
}

// Half of the way between the front and the back of what the middle joint moves; 0 if that is nothing.
double halfThickness(const TriangleMesh& mesh, const SkinWeights& weights, const LimbJoints& limb) {
  float front = -std::numeric_limits<float>::infinity(), back = -front;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (shareOf(weights, v, limb[1]) < 0.8) continue;
    front = std::max(front, mesh.vertices(v, 2));
    back = std::min(back, mesh.vertices(v, 2));
  }
  return front > back ? double(front - back) / 2 : 0;
}

double confidence(const Skeleton& skeleton, const LimbJoints& limb) {
  double sum = 0;
  for (const int j : limb) sum += skeleton.joints[std::size_t(j)].confidence;
  return sum / double(limb.size());
}

}  // namespace

void partLimbsInDepth(TriangleMesh& mesh, Skeleton& skeleton, const SkinWeights& weights,
                      const SkeletonTemplate& body_plan, double yaw_rad, const std::vector<int>& far_limbs) {
  SKEL_CHECK_EQ(mesh.vertices.rows(), weights.joints.rows());
  const double turned = body_plan.from_side ? 1 : std::abs(std::sin(yaw_rad));
  if (turned == 0) return;
  std::vector<double> depth(skeleton.joints.size(), 0);
  const auto inSkeleton = [&](const TemplateLimb& limb) {
    LimbJoints joints;
    for (std::size_t i = 0; i < joints.size(); ++i)
      joints[i] = skeleton.find(body_plan.joints[std::size_t(limb.joints[i])].name);
    return joints;
  };
  const auto isFar = [&](int limb) {
    return std::find(far_limbs.begin(), far_limbs.end(), limb + 1) != far_limbs.end();
  };
  for (const auto& [first, second] : body_plan.limbPairs()) {
    LimbJoints near = inSkeleton(body_plan.limbs[std::size_t(first)]),
               far = inSkeleton(body_plan.limbs[std::size_t(second)]);
    if (*std::min_element(near.begin(), near.end()) < 0 || *std::min_element(far.begin(), far.end()) < 0)
      continue;
    constexpr double kSurer = 0.05, kApart = 1.3;
    if (isFar(first) || (!isFar(second) && confidence(skeleton, far) > confidence(skeleton, near) + kSurer))
      std::swap(near, far);
    for (const int j : near) depth[std::size_t(j)] = kApart * turned * halfThickness(mesh, weights, near);
    for (const int j : far) depth[std::size_t(j)] = -kApart * turned * halfThickness(mesh, weights, far);
  }
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    double moved = 0;
    for (int k = 0; k < 4; ++k) moved += double(weights.weights(v, k)) * depth[weights.joints(v, k)];
    mesh.vertices(v, 2) += float(moved);
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    skeleton.joints[j].position.z() += depth[j];
    if (skeleton.joints[j].tail) skeleton.joints[j].tail->z() += depth[j];
  }
}

}  // namespace skel
