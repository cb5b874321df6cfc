#include "libskel/skin/falloff.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

constexpr float kBand = 1.8f;        // reach beyond a joint, in radii of the thinner of the two bones
constexpr float kLeastEdges = 3;     // and at least so many edges of the mesh
constexpr float kApart = 0.4f;       // of that for bones that do not meet (the two thighs)
constexpr float kPercentile = 0.8f;  // of a bone's own vertices lie within this share of its radius

struct Nearest {
  int bone = -1;
  float distance = kUnreached;
};

Nearest nearestBone(const BoneDistances& distances, Eigen::Index vertex) {
  Nearest result;
  for (int b = 0; b < distances.cols(); ++b) {
    if (distances(vertex, b) < result.distance) result = {b, distances(vertex, b)};
  }
  return result;
}

}  // namespace

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

std::vector<float> boneRadii(const BoneDistances& distances) {
  std::vector<std::vector<float>> own(distances.cols());
  for (Eigen::Index v = 0; v < distances.rows(); ++v) {
    const Nearest nearest = nearestBone(distances, v);
    if (nearest.bone >= 0) own[nearest.bone].push_back(nearest.distance);
  }
  std::vector<float> radii;
  for (std::vector<float>& values : own) {
    if (values.empty()) {
      radii.push_back(0);
      continue;
    }
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(kPercentile * static_cast<float>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    radii.push_back(*at / kPercentile);
  }
  return radii;
}

JointWeights weightsFromDistances(const BoneDistances& distances, const std::vector<Bone>& bones,
                                  int joint_count, float edge_m) {
  const std::vector<float> radii = boneRadii(distances);
  const int count = static_cast<int>(bones.size());
  // Square of the reach of bone b over vertices of bone a.
  Eigen::MatrixXf reach2(count, count);
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      const float reach = std::max(kBand * std::min(radii[a], radii[b]), kLeastEdges * edge_m);
      reach2(b, a) = std::pow(bonesMeet(bones[a], bones[b]) ? reach : kApart * reach, 2.0f);
    }
  }
  JointWeights weights = JointWeights::Zero(distances.rows(), joint_count);
  for (Eigen::Index v = 0; v < distances.rows(); ++v) {
    const Nearest nearest = nearestBone(distances, v);
    if (nearest.bone < 0) continue;
    for (int b = 0; b < count; ++b) {
      const float beyond2 = distances(v, b) * distances(v, b) - nearest.distance * nearest.distance;
      if (!(beyond2 < reach2(b, nearest.bone))) continue;
      const float rest = 1 - std::sqrt(beyond2 / reach2(b, nearest.bone));
      float& weight = weights(v, bones[b].joint);
      weight = std::max(weight, rest * rest);
    }
  }
  return weights;
}

}  // namespace skel
