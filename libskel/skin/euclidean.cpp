// Distance through the air, as plain distance-field skinning has it: limbs side by side pull each other
// along.
#include <algorithm>
#include <cmath>

#include "libskel/core/segment.h"
#include "libskel/skin/methods.h"

namespace skel {

JointWeights euclideanWeights(const SkinInput& input) {
  const TriangleMesh& mesh = input.mesh;
  const std::vector<Bone>& bones = input.bones;
  const int vertices = static_cast<int>(mesh.vertices.rows()), count = static_cast<int>(bones.size());
  BoneDistances distances2(vertices, count);  // m²
  // A bone's radius: that of most vertices that are nearest to it.
  std::vector<std::vector<float>> own(count);
  for (int v = 0; v < vertices; ++v) {
    int nearest = 0;
    for (int b = 0; b < count; ++b) {
      const float distance =
          distanceToSegment<Eigen::Vector3f>(mesh.vertices.row(v), bones[b].from, bones[b].to);
      distances2(v, b) = distance * distance;
      if (distances2(v, b) < distances2(v, nearest)) nearest = b;
    }
    own[nearest].push_back(std::sqrt(distances2(v, nearest)));
  }
  const float edge_m = meanEdge(mesh);
  std::vector<float> reach_m;  // of each bone
  for (int b = 0; b < count; ++b) {
    float radius = 0;
    if (!own[b].empty()) {
      const auto middle = own[b].begin() + static_cast<std::ptrdiff_t>(own[b].size() / 2);
      std::nth_element(own[b].begin(), middle, own[b].end());
      radius = *middle;
    }
    reach_m.push_back(reachBeyondJoint(radius, edge_m));
  }
  const auto reaches = [&](Eigen::Index v, std::vector<BoneReach>& row) {
    for (int b = 0; b < count; ++b) row[b] = {distances2(v, b), distances2(v, b), reach_m[b]};
  };
  return weightsFromReaches(vertices, bones, input.jointCount(), reaches);
}

}  // namespace skel
