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
  BoneReaches reaches(vertices, count);
  // A bone's radius: that of most vertices that are nearest to it.
  std::vector<std::vector<float>> own(count);
  for (int v = 0; v < vertices; ++v) {
    int nearest = 0;
    for (int b = 0; b < count; ++b) {
      const float distance =
          distanceToSegment<Eigen::Vector3f>(mesh.vertices.row(v), bones[b].from, bones[b].to);
      reaches(v, b).distance_m2 = reaches(v, b).power_m2 = distance * distance;
      if (reaches(v, b).power_m2 < reaches(v, nearest).power_m2) nearest = b;
    }
    own[nearest].push_back(std::sqrt(reaches(v, nearest).power_m2));
  }
  const float edge_m = meanEdge(mesh);
  for (int b = 0; b < count; ++b) {
    float radius = 0;
    if (!own[b].empty()) {
      const auto middle = own[b].begin() + static_cast<std::ptrdiff_t>(own[b].size() / 2);
      std::nth_element(own[b].begin(), middle, own[b].end());
      radius = *middle;
    }
    const float reach = reachBeyondJoint(radius, edge_m);
    for (int v = 0; v < vertices; ++v) reaches(v, b).reach_m = reach;
  }
  return weightsFromReaches(reaches, bones, input.jointCount());
}

}  // namespace skel
