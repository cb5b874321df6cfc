#include "libskel/skin/falloff.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

// A limb is drawn along by another one where they touch, but no farther.
constexpr float kForeign = 0.1f;

}  // namespace

JointWeights weightsFromReaches(const BoneReaches& reaches, const std::vector<Bone>& bones, int joint_count) {
  JointWeights weights = JointWeights::Zero(reaches.rows(), joint_count);
  for (Eigen::Index v = 0; v < reaches.rows(); ++v) {
    Eigen::Index nearest;
    const float least =
        reaches.row(v).unaryExpr([](const BoneReach& r) { return r.power_m2; }).minCoeff(&nearest);
    if (least == std::numeric_limits<float>::infinity()) continue;
    const int limb = bones[nearest].limb;
    for (Eigen::Index b = 0; b < reaches.cols(); ++b) {
      const bool foreign = limb >= 0 && bones[b].limb >= 0 && bones[b].limb != limb;
      // The thinner of the two says how far: the trunk does not reach far down an arm.
      const float reach =
          (foreign ? kForeign : 1) * std::min(reaches(v, b).reach_m, reaches(v, nearest).reach_m);
      const float beyond2 = reaches(v, b).power_m2 - least;
      if (beyond2 > 0 && beyond2 >= reach * reach) continue;
      const float rest = beyond2 > 0 ? 1 - std::sqrt(beyond2) / reach : 1;
      float& weight = weights(v, bones[b].joint);
      weight = std::max(weight, rest * rest);
    }
  }
  return weights;
}

float reachBeyondJoint(float radius_m, float edge_m) {
  // A bend by 90° folds the inner side of a limb over itself when the weights change within less than its
  // radius.
  constexpr float kRadii = 1.8f, kEdges = 3;
  return std::max(kRadii * radius_m, kEdges * edge_m);
}

float meanEdge(const TriangleMesh& mesh) {
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sum += (mesh.vertices.row(mesh.triangles(t, k)) - mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)))
                 .norm();
    }
  }
  return static_cast<float>(sum /
                            (3.0 * static_cast<double>(std::max<Eigen::Index>(1, mesh.triangles.rows()))));
}

}  // namespace skel
