// Inverse distance weights, as the elk system has them.
#include "libskel/skin/idw.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/segment.h"
#include "libskel/skin/methods.h"

namespace skel {

void boneDistances(const Eigen::Vector3f& p, const std::vector<Bone>& bones,
                   std::vector<BoneDistance>& result) {
  result.clear();
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Eigen::Vector3f nearest = nearestOnSegment<Eigen::Vector3f>(p, bones[b].from, bones[b].to);
    result.push_back({(nearest - p).norm(), bones[b].joint, static_cast<int>(b)});
  }
}

void shareByDistance(std::vector<BoneDistance>& bones, std::size_t count, float power, float* weights) {
  if (bones.empty()) return;
  count = std::min(count, bones.size());
  std::partial_sort(bones.begin(), bones.begin() + static_cast<std::ptrdiff_t>(count), bones.end());
  constexpr float kLeast_m = 0.001f;
  const float least_m = std::max(bones[0].distance_m, kLeast_m);
  for (std::size_t k = 0; k < count; ++k) {
    const float times = std::max(bones[k].distance_m, kLeast_m) / least_m;
    weights[bones[k].joint] += 1 / (std::pow(times, power) + 0.01f);
  }
}

JointWeights idwWeights(const SkinInput& input) {
  JointWeights weights = JointWeights::Zero(input.mesh.vertices.rows(), input.jointCount());
  std::vector<BoneDistance> bones;
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    boneDistances(input.mesh.vertices.row(v), input.bones, bones);
    shareByDistance(bones, 4, 2, weights.row(v).data());
  }
  return weights;
}

}  // namespace skel
