// A joint bent by 90° moves a point at p from it to A·p with A = (1 − w)·I + w·R, w the weight of all that
// the joint moves, and the plane about it by A + D·∇wᵀ, D = (R − I)·p. That turns inside out where ∇w·A⁻¹D <
// −1. A⁻¹D is as long as √2·|p| / √((1 − w)² + w²), and for w = ½ it lies square to p: so |∇w × p| must stay
// below √((1 − w)² + w²) / √2.
#include "libskel/skin/soften.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "libskel/skin/bones.h"

namespace skel {
namespace {

constexpr float kLargestChange = 0.27f;  // along an edge
constexpr float kFineMesh = 0.03f;       // mean edge, of the mesh's size: coarse ones cannot but change much
constexpr float kBend = 0.8f;            // of what would turn a triangle inside out
// In distances from the joint to the nearest vertex: farther out the limb has ended, or lies against the
// trunk.
constexpr float kRange = 3;
constexpr int kSweeps = 50;

// The joints each of which bends the middle of a limb, with what it moves.
struct Hinge {
  Eigen::Vector3f position;
  std::vector<int> moved;
  std::vector<int> others;  // joints of other limbs
  float range = 0;          // m

  float foreign(const float* weights) const {
    float sum = 0;
    for (const int joint : others) sum += weights[joint];
    return sum;
  }
};

std::vector<Hinge> hinges(const Skeleton& skeleton) {
  const std::vector<int> limbs = jointLimbs(skeleton);
  const int count = static_cast<int>(skeleton.joints.size());
  std::vector<Hinge> result;
  for (int joint = 1; joint < count; ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (limbs[joint] < 0 || limbs[joint] == joint || limbs[parent] != limbs[joint]) continue;
    Hinge hinge;
    hinge.position = skeleton.joints[joint].position.cast<float>();
    for (int moved = joint; moved < count; ++moved) {
      if (limbs[moved] == limbs[joint]) hinge.moved.push_back(moved);
    }
    for (int other = 0; other < count; ++other) {
      if (limbs[other] >= 0 && limbs[other] != limbs[joint]) hinge.others.push_back(other);
    }
    result.push_back(std::move(hinge));
  }
  return result;
}

}  // namespace

void softenWeights(const TriangleMesh& mesh, const Skeleton& skeleton, JointWeights& weights) {
  const int vertices = static_cast<int>(weights.rows()), joints = static_cast<int>(weights.cols());
  const int triangles = static_cast<int>(mesh.triangles.rows());
  for (int v = 0; v < vertices; ++v) weights.row(v) /= weights.row(v).sum();
  if (triangles == 0) return;
  const float size = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
  const float edge_m = meanEdge(mesh);
  const bool fine = edge_m < kFineMesh * size;
  std::vector<Hinge> bends = hinges(skeleton);
  for (Hinge& hinge : bends) {
    const Eigen::RowVector3f at = hinge.position;
    const float radius = std::sqrt((mesh.vertices.rowwise() - at).rowwise().squaredNorm().minCoeff());
    hinge.range = kRange * std::max(radius, edge_m);
  }

  // How many times too large the changes in a triangle are.
  const auto excess = [&](int triangle) {
    const Eigen::RowVector3i t = mesh.triangles.row(triangle);
    const float *a = weights.row(t[0]).data(), *b = weights.row(t[1]).data(), *c = weights.row(t[2]).data();
    float change = 0;
    for (int j = 0; j < joints; ++j) {
      const float high = std::max(std::max(a[j], b[j]), c[j]), low = std::min(std::min(a[j], b[j]), c[j]);
      change = std::max(change, high - low);
    }
    if (change < 0.02f) return 0.0f;
    const Eigen::Vector3f p = mesh.vertices.row(t[0]), q = mesh.vertices.row(t[1]),
                          r = mesh.vertices.row(t[2]);
    float result = fine ? change / kLargestChange : 0;
    const Eigen::Vector3f normal = (q - p).cross(r - p), middle = (p + q + r) / 3;
    const float double_area2 = normal.squaredNorm();
    if (double_area2 == 0) return result;
    for (const Hinge& hinge : bends) {
      const Eigen::Vector3f arm = middle - hinge.position;
      if (arm.squaredNorm() > hinge.range * hinge.range) continue;
      Eigen::Vector3f w = Eigen::Vector3f::Zero();
      for (const int joint : hinge.moved) w += Eigen::Vector3f(a[joint], b[joint], c[joint]);
      // Where two limbs touch, nothing but weights that blur both could bend one without a crease.
      const float foreign = std::max({hinge.foreign(a), hinge.foreign(b), hinge.foreign(c)});
      if (foreign > 0.02f) continue;
      const Eigen::Vector3f gradient =
          normal.cross(w[0] * (r - q) + w[1] * (p - r) + w[2] * (q - p)) / double_area2;
      const float mean = w.mean();
      const float limit = std::sqrt(0.5f * ((1 - mean) * (1 - mean) + mean * mean));
      result = std::max(result, gradient.cross(arm).norm() / (kBend * limit));
    }
    return result;
  };

  std::vector<int> first(vertices + 1, 0), around(3 * static_cast<std::size_t>(triangles));
  for (int t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) ++first[mesh.triangles(t, k) + 1];
  }
  for (int v = 0; v < vertices; ++v) first[v + 1] += first[v];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) around[next[mesh.triangles(t, k)]++] = t;
  }
  // Only what lies around a change needs another look.
  std::vector<int> waiting(triangles), later;
  std::iota(waiting.begin(), waiting.end(), 0);
  std::vector<int> queued(triangles, 0);
  for (int sweep = 1; sweep <= kSweeps && !waiting.empty(); ++sweep) {
    later.clear();
    for (const int triangle : waiting) {
      const float times = excess(triangle);
      if (times <= 1) continue;
      // The rows come nearer to their mean, so that all their differences shrink.
      const float keep = 1 / std::min(1.05f * times, 4.0f);
      float* rows[3];
      for (int k = 0; k < 3; ++k) rows[k] = weights.row(mesh.triangles(triangle, k)).data();
      for (int j = 0; j < joints; ++j) {
        const float mean = (rows[0][j] + rows[1][j] + rows[2][j]) / 3;
        for (float* row : rows) row[j] = mean + keep * (row[j] - mean);
      }
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.triangles(triangle, k);
        for (int i = first[v]; i < first[v + 1]; ++i) {
          if (queued[around[i]] == sweep) continue;
          queued[around[i]] = sweep;
          later.push_back(around[i]);
        }
      }
    }
    std::sort(later.begin(), later.end());
    waiting.swap(later);
  }
}

}  // namespace skel
