#include "libskel/skin/falloff.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

// A limb is drawn along by another one where they touch, but no farther.
constexpr float kForeign = 0.1f;

// 1 at the nearest, 0 from `reach_m` on.
float falloff(float beyond_m2, float reach_m) {
  if (beyond_m2 <= 0) return 1;
  if (beyond_m2 >= reach_m * reach_m) return 0;
  const float rest = 1 - std::sqrt(beyond_m2) / reach_m;
  return rest * rest;
}

}  // namespace

JointWeights weightsFromReaches(Eigen::Index vertices, const std::vector<Bone>& bones, int joint_count,
                                const ReachesOf& reaches_of, TrunkBones trunk) {
  struct Limb {
    const BoneReach *by_power, *by_distance;  // its nearest bones
  };
  const BoneReach no_way;
  std::vector<Limb> limbs(joint_count + 1);  // the last one: the trunk
  std::vector<BoneReach> reaches(bones.size());
  JointWeights weights = JointWeights::Zero(vertices, joint_count);
  for (Eigen::Index v = 0; v < vertices; ++v) {
    std::fill(reaches.begin(), reaches.end(), no_way);
    reaches_of(v, reaches);
    std::fill(limbs.begin(), limbs.end(), Limb{&no_way, &no_way});
    const BoneReach* nearest = &no_way;
    int nearest_limb = -1;
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const BoneReach& bone = reaches[b];
      if (bone.power_m2 < nearest->power_m2) nearest = &bone, nearest_limb = bones[b].limb;
      Limb& limb = limbs[bones[b].limb < 0 ? joint_count : bones[b].limb];
      if (bone.power_m2 < limb.by_power->power_m2) limb.by_power = &bone;
      if (bone.distance_m2 < limb.by_distance->distance_m2) limb.by_distance = &bone;
    }
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const BoneReach& bone = reaches[b];
      if (bone.distance_m2 == no_way.distance_m2) continue;
      const bool of_limb = bones[b].limb >= 0;
      const Limb limb = of_limb                         ? limbs[bones[b].limb]
                        : trunk == TrunkBones::kOneLimb ? limbs[joint_count]
                                                        : Limb{&bone, &bone};
      const bool foreign = of_limb && nearest_limb >= 0 && bones[b].limb != nearest_limb;
      // The thinner of two says how far: the trunk does not reach far down an arm.
      const float share =
          falloff(limb.by_power->power_m2 - nearest->power_m2,
                  (foreign ? kForeign : 1) * std::min(limb.by_power->reach_m, nearest->reach_m));
      if (share == 0) continue;
      const float within = falloff(bone.distance_m2 - limb.by_distance->distance_m2,
                                   std::min(bone.reach_m, limb.by_distance->reach_m));
      float& weight = weights(v, bones[b].joint);
      weight = std::max(weight, share * within);
    }
  }
  return weights;
}

float reachBeyondJoint(float radius_m, float edge_m) {
  // A bend by 90° folds the inner side of a limb over itself when the weights change within less than three
  // quarters of its radius to either side.
  constexpr float kRadii = 1.2f, kEdges = 3;
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
