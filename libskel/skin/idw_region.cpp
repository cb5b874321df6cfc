// Inverse distance weights within regions of the body: the nearest bone decides over a vertex's region, and
// only bones of regions that may mix with it share the vertex.
#include <algorithm>

#include "libskel/skin/idw.h"
#include "libskel/skin/methods.h"
#include "libskel/skin/regions.h"

namespace skel {
namespace {

// For each pair of joints (row, column) whether both have bones that may share a vertex that is nearest to a
// bone of the first.
std::vector<char> mixingJoints(const SkinRegions& table, const std::vector<int>& region_of,
                               const Skeleton& skeleton) {
  const std::size_t regions = table.regions.size(), joints = region_of.size();
  std::vector<char> regions_mix(regions * regions, 0);
  for (std::size_t r = 0; r < regions; ++r)
    for (const int other : table.regions[r].mixes) regions_mix[r * regions + std::size_t(other)] = 1;
  std::vector<char> mixes(joints * joints), on_chain(joints);
  for (std::size_t joint = 0; joint < joints; ++joint) {
    // Above it in the tree, itself, and below it.
    std::fill(on_chain.begin(), on_chain.end(), 0);
    for (int above = int(joint); above >= 0; above = skeleton.joints[above].parent) on_chain[above] = 1;
    for (std::size_t other = joint + 1; other < joints; ++other) {
      const int parent = skeleton.joints[other].parent;
      on_chain[other] = parent >= int(joint) && on_chain[parent];
    }
    const auto region = std::size_t(region_of[joint]);
    for (std::size_t other = 0; other < joints; ++other) {
      const auto another = std::size_t(region_of[other]);
      mixes[joint * joints + other] =
          regions_mix[region * regions + another] &&
          (!table.regions[region].own_chain || !table.regions[another].own_chain || on_chain[other]);
    }
  }
  return mixes;
}

}  // namespace

JointWeights idwRegionWeights(const SkinInput& input) {
  const SkinRegions& table = input.options.regions ? *input.options.regions : defaultRegions();
  const std::vector<int> region_of = table.ofJoints(input.skeleton);
  const int joints = input.jointCount();
  const std::vector<char> mixes = mixingJoints(table, region_of, input.skeleton);
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
