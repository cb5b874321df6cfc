// Inverse distance weights within regions of the body: the nearest bone decides over a vertex's region, and
// only bones of regions that may mix with it share the vertex.
#include <algorithm>

#include "libskel/skin/idw.h"
#include "libskel/skin/methods.h"
#include "libskel/skin/regions.h"

namespace skel {
namespace {

// Whether one of the joints is above the other in the tree, or both are the same.
bool onOneChain(const Skeleton& skeleton, int a, int b) {
  int joint = std::max(a, b);
  while (joint > std::min(a, b)) joint = skeleton.joints[joint].parent;
  return joint == std::min(a, b);
}

}  // namespace

JointWeights idwRegionWeights(const SkinInput& input) {
  const SkinRegions& table = input.options.regions ? *input.options.regions : defaultRegions();
  const std::vector<int> region_of = table.ofJoints(input.skeleton);
  const int joints = input.jointCount();
  // Whether the bones of `other` may share a vertex that is nearest to one of `joint`.
  std::vector<char> mixes(static_cast<std::size_t>(joints) * joints);
  for (int joint = 0; joint < joints; ++joint) {
    const SkinRegion& region = table.regions[region_of[joint]];
    for (int other = 0; other < joints; ++other) {
      const SkinRegion& another = table.regions[region_of[other]];
      const bool allowed =
          std::find(region.mixes.begin(), region.mixes.end(), region_of[other]) != region.mixes.end();
      const bool chain = !region.own_chain || !another.own_chain || onOneChain(input.skeleton, joint, other);
      mixes[static_cast<std::size_t>(joint) * joints + other] = allowed && chain;
    }
  }
  JointWeights weights = JointWeights::Zero(input.mesh.vertices.rows(), joints);
  std::vector<BoneDistance> bones;
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    boneDistances(input.mesh.vertices.row(v), input.bones, bones);
    const BoneDistance nearest =
        *std::min_element(bones.begin(), bones.end(), [&](const BoneDistance& a, const BoneDistance& b) {
          return a.distance_m < b.distance_m ||
                 (a.distance_m == b.distance_m && region_of[a.joint] < region_of[b.joint]);
        });
    const SkinRegion& region = table.regions[region_of[nearest.joint]];
    if (region.rigid) {
      weights(v, nearest.joint) = 1;
      continue;
    }
    const char* may = mixes.data() + static_cast<std::size_t>(nearest.joint) * joints;
    bones.erase(
        std::remove_if(bones.begin(), bones.end(), [&](const BoneDistance& b) { return !may[b.joint]; }),
        bones.end());
    shareByDistance(bones, 4, static_cast<float>(region.power), weights.row(v).data());
  }
  return weights;
}

}  // namespace skel
