#include "libskel/skin/parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "libskel/skeleton/place_in_mesh.h"
#include "libskel/skin/vertex_tree.h"

namespace skel {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

int find(std::vector<int>& above, int v) {
  while (above[v] != v) v = above[v] = above[above[v]];
  return v;
}

void join(std::vector<int>& above, int a, int b) {
  a = find(above, a), b = find(above, b);
  above[std::max(a, b)] = std::min(a, b);
}

}  // namespace

MeshParts meshParts(const TriangleMesh& mesh, const Welding& welding) {
  const int count = static_cast<int>(mesh.vertices.rows());
  std::vector<int> above(static_cast<std::size_t>(count));
  std::iota(above.begin(), above.end(), 0);
  for (int v = 0; v < count; ++v) join(above, welding.vertex(welding.place(v)), v);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    join(above, mesh.triangles(t, 0), mesh.triangles(t, 1));
    join(above, mesh.triangles(t, 0), mesh.triangles(t, 2));
  }
  MeshParts parts;
  parts.of_vertex.assign(static_cast<std::size_t>(count), -1);
  for (int v = 0; v < count; ++v) {
    const int top = find(above, v);  // the part's first vertex
    parts.of_vertex[v] = top == v ? parts.count++ : parts.of_vertex[top];
  }
  return parts;
}

std::vector<char> partsWithBones(const TriangleMesh& mesh, const MeshParts& parts,
                                 const std::vector<Bone>& bones) {
  constexpr int kSamples = 2;    // a bone
  constexpr float kNear = 1.5f;  // times the nearest part's distance
  std::vector<Eigen::Vector3d> points;
  for (const Bone& bone : bones)
    for (int k = 0; k < kSamples; ++k)
      points.push_back((bone.from + (bone.to - bone.from) * (static_cast<float>(2 * k + 1) / (2 * kSamples)))
                           .cast<double>());
  std::vector<char> with_bones(static_cast<std::size_t>(parts.count), 0);
  std::vector<Eigen::Index> lonely;  // points in no part
  const std::vector<std::vector<int>> around = groupsAround(points, mesh, parts.of_vertex);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const int part : around[i]) with_bones[part] = 1;
    if (around[i].empty()) lonely.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<float> distances(static_cast<std::size_t>(parts.count));
  for (const Eigen::Index i : lonely) {
    std::fill(distances.begin(), distances.end(), kFar);
    const Eigen::RowVector3f p = points[static_cast<std::size_t>(i)].cast<float>().transpose();
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      float& distance = distances[parts.of_vertex[v]];
      distance = std::min(distance, (mesh.vertices.row(v) - p).squaredNorm());
    }
    const float least = *std::min_element(distances.begin(), distances.end());
    for (int part = 0; part < parts.count; ++part)
      if (distances[part] <= kNear * kNear * least) with_bones[part] = 1;
  }
  return with_bones;
}

void followTouchedParts(const TriangleMesh& mesh, const MeshParts& parts, const std::vector<char>& with_bones,
                        JointWeights& weights) {
  if (std::find(with_bones.begin(), with_bones.end(), 0) == with_bones.end()) return;
  const float edge_m = meanEdge(mesh);
  VertexTree known(mesh.vertices);  // of the parts that know their weights
  std::vector<std::vector<int>> members(static_cast<std::size_t>(parts.count));
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    members[parts.of_vertex[v]].push_back(v);
    if (with_bones[parts.of_vertex[v]]) known.add(v);
  }
  const auto gap = [&](int part, float limit) {
    for (const int v : members[part])
      limit = std::min(limit, known.nearest(mesh.vertices.row(v), limit).distance_m);
    return limit;
  };
  const auto follow = [&](int part, float least) {
    Eigen::VectorXf sums = Eigen::VectorXf::Zero(weights.cols());
    for (const int v : members[part]) {
      const int touched = known.nearest(mesh.vertices.row(v), least + edge_m).vertex;
      if (touched >= 0) sums += weights.row(touched).transpose() / weights.row(touched).sum();
    }
    Eigen::Index joint = 0;
    sums.maxCoeff(&joint);
    for (const int v : members[part]) {
      weights.row(v).setZero();
      weights(v, joint) = 1;
    }
    for (const int v : members[part]) known.add(v);
  };
  // The nearest first, so that a pupil follows its eye.
  struct Waiting {
    float least;  // no nearer than this to what is known
    int part;
    float measured;  // as near as this, at least
    bool operator<(const Waiting& other) const {
      return std::pair(least, part) < std::pair(other.least, other.part);
    }
  };
  std::vector<Waiting> waiting;
  for (int part = 0; part < parts.count; ++part) {
    if (with_bones[part]) continue;
    const float distance = gap(part, kFar);
    waiting.push_back({distance, part, distance});
  }
  // Crumbs: whatever they touch, they lie by the body.
  if (waiting.size() > 64) {
    std::sort(waiting.rbegin(), waiting.rend());
    for (; waiting.size() > 64; waiting.pop_back()) follow(waiting.back().part, waiting.back().measured);
    for (Waiting& one : waiting) one.least = 0;
  }
  std::vector<Eigen::AlignedBox3f> boxes(static_cast<std::size_t>(parts.count));
  for (const Waiting& one : waiting)
    for (const int v : members[one.part]) boxes[one.part].extend(mesh.vertices.row(v).transpose());
  while (!waiting.empty()) {
    const auto next = std::min_element(waiting.begin(), waiting.end());
    if (next->least < next->measured) {
      next->least = next->measured = gap(next->part, next->measured);
      continue;
    }
    const Waiting nearest = *next;
    waiting.erase(next);
    follow(nearest.part, nearest.measured);
    for (Waiting& one : waiting)
      one.least = std::min(one.least, boxes[one.part].exteriorDistance(boxes[nearest.part]));
  }
}

}  // namespace skel
