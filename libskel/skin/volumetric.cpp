// O. Dionne, M. de Lasa, "Geodesic voxel binding for production character meshes" (2013). Ways go from cube
// to cube (Dijkstra 1959, from all bones at once) and are up to 13 % too long: where one is hardly longer
// than the straight line, nothing lies between, and the straight line counts, as in geodesic.cpp.
#include "libskel/skin/volumetric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/core/segment.h"
#include "libskel/skin/fronts.h"
#include "libskel/skin/solid.h"

namespace skel {
namespace {

constexpr float kDetour = 1.14f;  // of steps to 26 neighbours
constexpr float kPenalty = 2;     // how much a way around something counts beyond its own length
constexpr float kFar = std::numeric_limits<float>::infinity();

float straight(const Eigen::Vector3f& p, const Bone& bone) {
  return distanceToSegment<Eigen::Vector3f>(p, bone.from, bone.to);
}

// Half the body's thickness about each bone: the distance of most vertices that are nearest to it.
std::vector<float> boneRadii(const BoneReaches& reaches) {
  std::vector<std::vector<float>> own(static_cast<std::size_t>(reaches.cols()));
  for (Eigen::Index v = 0; v < reaches.rows(); ++v) {
    Eigen::Index nearest = 0;
    for (Eigen::Index b = 1; b < reaches.cols(); ++b)
      if (reaches(v, b).distance_m2 < reaches(v, nearest).distance_m2) nearest = b;
    if (reaches(v, nearest).distance_m2 < kFar)
      own[static_cast<std::size_t>(nearest)].push_back(std::sqrt(reaches(v, nearest).distance_m2));
  }
  std::vector<float> radii;
  for (std::vector<float>& distances : own) {
    radii.push_back(0);
    if (distances.empty()) continue;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    radii.back() = *middle;
  }
  return radii;
}

}  // namespace

JointWeights volumetricWeights(const SkinInput& input) {
  const TriangleMesh& mesh = input.mesh;
  const std::vector<Bone>& bones = input.bones;
  const Solid solid(mesh);
  const float cell_m = solid.cell_m();
  const int count = static_cast<int>(bones.size());
  Fronts fronts(0.5f * cell_m);
  using Lengths = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Lengths way = Lengths::Constant(solid.size(), count, kFar);
  const auto reach = [&](int cube, int bone, float distance) {
    if (distance >= way(cube, bone)) return;
    way(cube, bone) = distance;
    fronts.push({distance, cube, bone});
  };
  for (int b = 0; b < count; ++b) {
    const Eigen::Vector3f along = bones[b].to - bones[b].from;
    const int steps = std::clamp(static_cast<int>(2 * along.norm() / cell_m) + 1, 1, 1000);
    bool seeded = false;
    for (int k = 0; k <= steps; ++k) {
      const int cube = solid.at(bones[b].from + along * (static_cast<float>(k) / static_cast<float>(steps)));
      if (cube < 0) continue;
      reach(cube, b, straight(solid.center(cube), bones[b]));
      seeded = true;
    }
    if (seeded) continue;
    // A bone beside the body belongs to what is nearest.
    const int cube = solid.nearest(0.5f * (bones[b].from + bones[b].to));
    reach(cube, b, straight(solid.center(cube), bones[b]));
  }
  // A way this much longer than the first that came brings no weight any more, nor does any that goes on from
  // it.
  std::vector<float> first(static_cast<std::size_t>(solid.size()), kFar);
  const auto useless = [&](int cube, float distance) {
    return distance > kDetour * (1.6f * first[cube] + 4 * cell_m);
  };
  for (Fronts::Front front; fronts.pop(front);) {
    if (front.distance > way(front.place, front.bone)) continue;
    first[front.place] = std::min(first[front.place], front.distance);
    if (useless(front.place, front.distance)) continue;
    solid.forNeighbours(front.place, [&](const Solid::Step& step) {
      const float distance = front.distance + step.length_m;
      if (distance < way(step.to, front.bone) && !useless(step.to, distance))
        reach(step.to, front.bone, distance);
    });
  }

  BoneReaches reaches(mesh.vertices.rows(), count);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector3f p = mesh.vertices.row(v);
    const int cube = solid.at(p);
    if (cube < 0) continue;
    for (int b = 0; b < count; ++b) {
      if (way(cube, b) == kFar) continue;
      const float direct = straight(p, bones[b]);
      const float around = std::max(0.0f, way(cube, b) - kDetour * direct - 2 * cell_m);
      const float distance = direct + kPenalty * around;
      reaches(v, b).distance_m2 = distance * distance;
    }
  }
  const float edge_m = meanEdge(mesh);
  const std::vector<float> radii = boneRadii(reaches);
  for (int b = 0; b < count; ++b) {
    const float reach_m = reachBeyondJoint(radii[b], edge_m);
    for (Eigen::Index v = 0; v < reaches.rows(); ++v) {
      BoneReach& here = reaches(v, b);
      if (here.distance_m2 == kFar) continue;
      here.power_m2 = here.distance_m2 - radii[b] * radii[b];
      here.reach_m = reach_m;
    }
  }
  return weightsFromReaches(reaches, bones, input.jointCount());
}

}  // namespace skel
