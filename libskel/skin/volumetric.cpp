// O. Dionne, M. de Lasa, "Geodesic voxel binding for production character meshes" (2013). Ways go from cube
// to cube (Dijkstra 1959) and are up to 13 % too long: where one is hardly longer than the straight line,
// nothing lies between, and the straight line counts, as in geodesic.cpp.
#include "libskel/skin/volumetric.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "libskel/core/error.h"
#include "libskel/core/segment.h"
#include "libskel/skin/fronts.h"
#include "libskel/skin/solid.h"

namespace skel {
namespace {

constexpr float kDetour = 1.14f;  // of steps to 26 neighbours
constexpr float kPenalty = 2;     // how much a way around something counts beyond its own length
constexpr std::int64_t kMostSteps = 60'000'000;  // cubes that the ways of all bones come to: some seconds
constexpr float kFar = std::numeric_limits<float>::infinity();

float straight(const Eigen::Vector3f& p, const Bone& bone) {
  return distanceToSegment<Eigen::Vector3f>(p, bone.from, bone.to);
}

// Half the body's thickness about each bone: the distance of most vertices that are nearest to it. A spine
// runs along the back, far from the belly: for the trunk, nearly all of them.
std::vector<float> boneRadii(const BoneDistances& distances2, const std::vector<Bone>& bones) {
  std::vector<std::vector<float>> own(bones.size());
  for (Eigen::Index v = 0; v < distances2.rows(); ++v) {
    Eigen::Index nearest = 0;
    for (Eigen::Index b = 1; b < distances2.cols(); ++b)
      if (distances2(v, b) < distances2(v, nearest)) nearest = b;
    if (distances2(v, nearest) < kFar)
      own[static_cast<std::size_t>(nearest)].push_back(std::sqrt(distances2(v, nearest)));
  }
  std::vector<float> radii;
  for (std::size_t b = 0; b < own.size(); ++b) {
    std::vector<float>& distances = own[b];
    radii.push_back(0);
    if (distances.empty()) continue;
    const std::size_t most = bones[b].limb < 0 ? distances.size() * 9 / 10 : distances.size() / 2;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(distances.begin(), middle, distances.end());
    radii.back() = *middle;
  }
  return radii;
}

// Where ways begin, and how long they are already.
struct Seed {
  int cube;
  float length_m;
};
using Seeds = std::vector<Seed>;

Seeds seedsOf(const Bone& bone, const Solid& solid) {
  const Eigen::Vector3f along = bone.to - bone.from;
  const int steps = 1 + static_cast<int>(std::min(2 * along.norm() / solid.cell_m(), 1000.0f));
  Seeds seeds;
  const auto add = [&](int cube) {
    if (seeds.empty() || seeds.back().cube != cube)
      seeds.push_back({cube, straight(solid.center(cube), bone)});
  };
  for (int k = 0; k <= steps; ++k) {
    const int cube = solid.at(bone.from + along * (static_cast<float>(k) / static_cast<float>(steps)));
    if (cube >= 0) add(cube);
  }
  // A bone beside the body belongs to what is nearest.
  if (seeds.empty()) add(solid.nearest(0.5f * (bone.from + bone.to)));
  return seeds;
}

// The shortest ways from some cubes to the others.
class Ways {
 public:
  explicit Ways(const Solid& solid) : solid_(solid), lengths_(static_cast<std::size_t>(solid.size()), kFar) {}

  // Only to where useful(cube, length).
  template <class Useful>
  void spread(const Seeds& seeds, const Useful& useful) {
    for (const int cube : touched_) lengths_[static_cast<std::size_t>(cube)] = kFar;
    touched_.clear();
    // Bones may lie far from the mesh.
    float farthest = 0;
    for (const Seed& seed : seeds) farthest = std::max(farthest, seed.length_m);
    Fronts fronts(std::max(0.5f * solid_.cell_m(), 1e-4f * farthest));
    const auto reach = [&](int cube, float length) {
      float& known = lengths_[static_cast<std::size_t>(cube)];
      if (length >= known || !useful(cube, length)) return;
      if (known == kFar) touched_.push_back(cube);
      known = length;
      fronts.push({length, cube, 0});
    };
    for (const Seed& seed : seeds) reach(seed.cube, seed.length_m);
    for (Fronts::Front front; fronts.pop(front);) {
      if (front.distance > lengths_[static_cast<std::size_t>(front.place)]) continue;
      ++steps_;
      solid_.forNeighbours(front.place,
                           [&](const Solid::Step& step) { reach(step.to, front.distance + step.length_m); });
    }
  }
  const std::vector<float>& lengths() const { return lengths_; }
  std::int64_t steps() const { return steps_; }

 private:
  const Solid& solid_;
  std::vector<float> lengths_;
  std::vector<int> touched_;
  std::int64_t steps_ = 0;  // of all spreads
};

}  // namespace

JointWeights volumetricWeights(const SkinInput& input) {
  const TriangleMesh& mesh = input.mesh;
  const std::vector<Bone>& bones = input.bones;
  const Solid solid(mesh);
  const int count = static_cast<int>(bones.size());
  std::vector<Seeds> seeds;
  Seeds all;
  for (const Bone& bone : bones) {
    seeds.push_back(seedsOf(bone, solid));
    all.insert(all.end(), seeds.back().begin(), seeds.back().end());
  }
  const float cell_m = solid.cell_m();
  Ways ways(solid);
  ways.spread(all, [](int, float) { return true; });
  const std::vector<float> nearest = ways.lengths();

  std::vector<int> cubes;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) cubes.push_back(solid.at(mesh.vertices.row(v)));
  BoneDistances distances2 = BoneDistances::Constant(mesh.vertices.rows(), count, kFar);  // m²
  for (int b = 0; b < count; ++b) {
    if (ways.steps() > kMostSteps)
      throw InputError(input.options.file,
                       "has too many bones (" + std::to_string(count) +
                           ") that lie close together; take fewer joints, or the skin method idw (--skin)");
    // A way this much longer than the nearest bone's brings no weight, nor does any that goes on from it.
    ways.spread(seeds[static_cast<std::size_t>(b)], [&](int cube, float length) {
      return length <= kDetour * (1.6f * nearest[static_cast<std::size_t>(cube)] + 3 * cell_m);
    });
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      const int cube = cubes[static_cast<std::size_t>(v)];
      const float way = cube < 0 ? kFar : ways.lengths()[static_cast<std::size_t>(cube)];
      if (way == kFar) continue;
      const float direct = straight(mesh.vertices.row(v), bones[static_cast<std::size_t>(b)]);
      const float around = std::max(0.0f, way - kDetour * direct - 2 * cell_m);
      const float distance = direct + kPenalty * around;
      distances2(v, b) = distance * distance;
    }
  }
  const float edge_m = meanEdge(mesh);
  const std::vector<float> radii = boneRadii(distances2, bones);
  const auto reaches = [&](Eigen::Index v, std::vector<BoneReach>& row) {
    for (int b = 0; b < count; ++b) {
      const float distance2 = distances2(v, b);
      if (distance2 == kFar) continue;
      row[b] = {distance2, distance2 - radii[b] * radii[b], reachBeyondJoint(radii[b], edge_m)};
    }
  };
  return weightsFromReaches(mesh.vertices.rows(), bones, input.jointCount(), reaches, TrunkBones::kOneLimb);
}

}  // namespace skel
