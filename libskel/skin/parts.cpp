#include "libskel/skin/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "libskel/skeleton/place_in_mesh.h"

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

// Vertices by cubes of space, to find those near a point.
class VertexBins {
 public:
  VertexBins(const Eigen::MatrixX3f& vertices, float cell_m) : vertices_(vertices), cell_m_(cell_m) {
    low_ = vertices.colwise().minCoeff();
    high_ = vertices.colwise().maxCoeff();
    cell_m_ = std::max({cell_m, (high_ - low_).maxCoeff() / 64, 1e-9f});
    for (int k = 0; k < 3; ++k) count_[k] = static_cast<int>((high_[k] - low_[k]) / cell_m_) + 1;
    bins_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
  }
  void add(int v) { bins_[bin(cellOf(vertices_.row(v)))].push_back(v); }
  // The nearest of those added: its distance, infinite if that is above `limit`.
  float nearest(const Eigen::Vector3f& p, float limit, int* which) const {
    float best = limit * limit;
    bool found = false;
    const std::array<int, 3> at = cellOf(p);
    const int most = std::max({count_[0], count_[1], count_[2]});
    for (int ring = 0; ring <= most; ++ring) {
      const float clear = static_cast<float>(ring - 1) * cell_m_;
      if (clear > 0 && clear * clear > best) break;
      forShell(at, ring, [&](int cell) {
        for (const int v : bins_[static_cast<std::size_t>(cell)]) {
          const float distance2 = (vertices_.row(v).transpose() - p).squaredNorm();
          if (distance2 > best || (found && distance2 == best)) continue;
          best = distance2, found = true;
          if (which) *which = v;
        }
      });
    }
    return found ? std::sqrt(best) : kFar;
  }

 private:
  std::array<int, 3> cellOf(const Eigen::Vector3f& p) const {
    std::array<int, 3> at{};
    for (int k = 0; k < 3; ++k)
      at[k] = std::clamp(static_cast<int>((p[k] - low_[k]) / cell_m_), 0, count_[k] - 1);
    return at;
  }
  std::size_t bin(const std::array<int, 3>& at) const {
    return static_cast<std::size_t>(at[0]) +
           static_cast<std::size_t>(count_[0]) * (at[1] + static_cast<std::size_t>(count_[1]) * at[2]);
  }
  template <class Visit>
  void forShell(const std::array<int, 3>& at, int ring, const Visit& visit) const {
    const auto span = [&](int k) {
      return std::pair(std::max(0, at[k] - ring), std::min(count_[k] - 1, at[k] + ring));
    };
    const auto [x0, x1] = span(0);
    const auto [y0, y1] = span(1);
    const auto [z0, z1] = span(2);
    for (int z = z0; z <= z1; ++z) {
      for (int y = y0; y <= y1; ++y) {
        const bool whole = std::abs(z - at[2]) == ring || std::abs(y - at[1]) == ring;
        for (int x = x0; x <= x1; ++x) {
          if (whole || std::abs(x - at[0]) == ring) visit(static_cast<int>(bin({x, y, z})));
        }
      }
    }
  }

  const Eigen::MatrixX3f& vertices_;
  float cell_m_;
  Eigen::Array3f low_, high_;
  std::array<int, 3> count_{};
  std::vector<std::vector<int>> bins_;
};

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
  VertexBins bins(mesh.vertices, edge_m);  // of the parts that know their weights
  std::vector<std::vector<int>> members(static_cast<std::size_t>(parts.count));
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    members[parts.of_vertex[v]].push_back(v);
    if (with_bones[parts.of_vertex[v]]) bins.add(v);
  }
  // The nearest first, so that a pupil follows its eye.
  // A search is short where something near is known: it begins with the vertex that is nearest to some of
  // them.
  std::vector<int> some;
  for (int v = 0; v < mesh.vertices.rows(); v += 1 + static_cast<int>(mesh.vertices.rows()) / 64)
    if (with_bones[parts.of_vertex[v]]) some.push_back(v);
  const auto gap = [&](int part, float limit) {
    float least = limit;
    for (const int v : members[part])
      for (const int known : some)
        least = std::min(least, (mesh.vertices.row(v) - mesh.vertices.row(known)).norm());
    const int stride = 1 + static_cast<int>(members[part].size()) / 16;
    for (std::size_t k = 0; k < members[part].size(); k += static_cast<std::size_t>(stride))
      least = std::min(least, bins.nearest(mesh.vertices.row(members[part][k]), least, nullptr));
    for (const int v : members[part]) {
      const float distance = bins.nearest(mesh.vertices.row(v), least, nullptr);
      least = std::min(least, distance);
    }
    return least;
  };
  std::vector<std::pair<float, int>> waiting;
  for (int part = 0; part < parts.count; ++part)
    if (!with_bones[part]) waiting.emplace_back(gap(part, kFar), part);
  while (!waiting.empty()) {
    const auto next = std::min_element(waiting.begin(), waiting.end());
    const auto [least, part] = *next;
    waiting.erase(next);
    Eigen::VectorXf sums = Eigen::VectorXf::Zero(weights.cols());
    for (const int v : members[part]) {
      int touched = -1;
      if (bins.nearest(mesh.vertices.row(v), least + edge_m, &touched) < kFar)
        sums += weights.row(touched).transpose() / weights.row(touched).sum();
    }
    Eigen::Index joint = 0;
    sums.maxCoeff(&joint);
    for (const int v : members[part]) {
      weights.row(v).setZero();
      weights(v, joint) = 1;
    }
    for (const int v : members[part]) bins.add(v);
    if (waiting.size() > 64) continue;  // crumbs: whatever they touch, they lie by the body
    for (auto& [distance, other] : waiting) distance = gap(other, distance);
  }
}

}  // namespace skel
