// Distance through the air, as plain distance-field skinning has it: limbs side by side pull each other
// along.
#include "libskel/skin/methods.h"

namespace skel {

JointWeights euclideanWeights(const TriangleMesh& mesh, const std::vector<Bone>& bones, int joint_count) {
  BoneDistances distances(mesh.vertices.rows(), static_cast<Eigen::Index>(bones.size()));
  for (Eigen::Index v = 0; v < distances.rows(); ++v) {
    for (Eigen::Index b = 0; b < distances.cols(); ++b) {
      distances(v, b) = distanceToSegment<3>(mesh.vertices.row(v), bones[b].from, bones[b].to);
    }
  }
  return weightsFromDistances(distances, bones, joint_count, meanEdge(mesh));
}

}  // namespace skel
