// Distance measured inside the body, along the mesh as seen from the front.
//
// The bones of a drawn figure lie in one plane and its body is deep about them, so that the way inside the
// body from a bone to a vertex is the way in that plane, depth left out. Ways follow the mesh's edges
// (Dijkstra 1959, from all bones at once), which know every gap between limbs; they start at the two walls
// before and behind each point of the bone. A way along edges is up to 8 % too long: where it is hardly
// longer than the straight line, nothing lies between, and the straight line counts.
#include "libskel/skin/methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace skel {
namespace {

// What a way along edges, with the two diagonals of each quad, can be longer than the straight line.
constexpr float kDetour = 1.12f;
// How much a way around something counts beyond its own length.
constexpr float kPenalty = 2;

// Triangles by the squares of the plane that they touch.
class TriangleBins {
 public:
  explicit TriangleBins(const TriangleMesh& mesh) : mesh_(mesh) {
    low_ = mesh.vertices.leftCols<2>().colwise().minCoeff();
    const Eigen::Vector2f size = mesh.vertices.leftCols<2>().colwise().maxCoeff().transpose() - low_;
    // About two triangles a square.
    cell_ =
        std::sqrt(std::max(size.x() * size.y(), 1e-12f) / static_cast<float>(mesh.triangles.rows() + 1) * 2);
    cell_ = std::max(cell_, size.maxCoeff() / 1000);
    columns_ = static_cast<int>(size.x() / cell_) + 1;
    rows_ = static_cast<int>(size.y() / cell_) + 1;
    first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    forEach([&](int bin, int) { ++first_[bin + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    triangles_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    forEach([&](int bin, int triangle) { triangles_[next[bin]++] = triangle; });
  }

  // The triangles just before and just behind a point, -1 for none.
  std::array<int, 2> walls(const Eigen::Vector3f& p) const {
    std::array<int, 2> result{-1, -1};
    std::array<float, 2> depth{kUnreached, kUnreached};
    const Eigen::Vector2f at = (p.head<2>() - low_) / cell_;
    if (at.minCoeff() < 0 || at.x() >= static_cast<float>(columns_) || at.y() >= static_cast<float>(rows_))
      return result;
    const int bin = static_cast<int>(at.y()) * columns_ + static_cast<int>(at.x());
    for (int k = first_[bin]; k < first_[bin + 1]; ++k) {
      const Eigen::RowVector3i t = mesh_.triangles.row(triangles_[k]);
      const Eigen::Vector3f a = mesh_.vertices.row(t[0]), b = mesh_.vertices.row(t[1]),
                            c = mesh_.vertices.row(t[2]);
      const auto cross = [&](const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
        return (u.x() - p.x()) * (v.y() - p.y()) - (v.x() - p.x()) * (u.y() - p.y());
      };
      const float wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), sum = wa + wb + wc;
      if (sum == 0 || wa * sum < 0 || wb * sum < 0 || wc * sum < 0) continue;
      const float z = (wa * a.z() + wb * b.z() + wc * c.z()) / sum - p.z();
      const int side = z >= 0 ? 0 : 1;
      if (std::abs(z) < depth[side]) depth[side] = std::abs(z), result[side] = triangles_[k];
    }
    return result;
  }

 private:
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      Eigen::Array2f low = Eigen::Array2f::Constant(kUnreached), high = -low;
      for (int k = 0; k < 3; ++k) {
        const int v = mesh_.triangles(t, k);
        const Eigen::Array2f p =
            (Eigen::Array2f(mesh_.vertices(v, 0), mesh_.vertices(v, 1)) - low_.array()) / cell_;
        low = low.min(p), high = high.max(p);
      }
      for (int y = static_cast<int>(low.y()); y <= std::min(static_cast<int>(high.y()), rows_ - 1); ++y) {
        for (int x = static_cast<int>(low.x()); x <= std::min(static_cast<int>(high.x()), columns_ - 1);
             ++x) {
          visit(y * columns_ + x, t);
        }
      }
    }
  }

  const TriangleMesh& mesh_;
  Eigen::Vector2f low_;
  float cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_, triangles_;
};

// Neighbours along edges and across them.
struct Graph {
  struct Arc {
    int to;
    float length;
  };
  std::vector<int> first;
  std::vector<Arc> arcs;
};

Graph buildGraph(const TriangleMesh& mesh) {
  struct Corner {
    int low, high, apex;
  };
  const auto between = [&](int a, int b) {
    return (mesh.vertices.row(a).head<2>() - mesh.vertices.row(b).head<2>()).norm();
  };
  // The edges of all triangles, by their lower vertex (counting sort), so that those that share one meet.
  const int vertices = static_cast<int>(mesh.vertices.rows()),
            triangles = static_cast<int>(mesh.triangles.rows());
  std::vector<int> start(vertices + 1, 0);
  for (int t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) ++start[std::min(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)) + 1];
  }
  for (int v = 0; v < vertices; ++v) start[v + 1] += start[v];
  std::vector<Corner> corners(3 * static_cast<std::size_t>(triangles));
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      corners[next[std::min(a, b)]++] = {std::min(a, b), std::max(a, b), mesh.triangles(t, (k + 2) % 3)};
    }
  }
  std::vector<std::array<int, 2>> links;
  links.reserve(corners.size());
  Graph graph;
  for (int v = 0; v < vertices; ++v) {
    const auto begin = corners.begin() + start[v], end = corners.begin() + start[v + 1];
    std::sort(begin, end, [](const Corner& a, const Corner& b) {
      return std::pair(a.high, a.apex) < std::pair(b.high, b.apex);
    });
    for (auto i = begin; i != end; ++i) {
      if (i == begin || i->high != (i - 1)->high) {
        links.push_back({i->low, i->high});
      } else {
        links.push_back({(i - 1)->apex, i->apex});
      }
    }
  }
  graph.first.assign(vertices + 1, 0);
  for (const auto& [a, b] : links) ++graph.first[a + 1], ++graph.first[b + 1];
  for (int v = 0; v < vertices; ++v) graph.first[v + 1] += graph.first[v];
  graph.arcs.resize(2 * links.size());
  next.assign(graph.first.begin(), graph.first.end() - 1);
  for (const auto& [a, b] : links) {
    const float length = between(a, b);
    graph.arcs[next[a]++] = {b, length};
    graph.arcs[next[b]++] = {a, length};
  }
  return graph;
}

}  // namespace

JointWeights geodesicWeights(const TriangleMesh& mesh, const std::vector<Bone>& bones, int joint_count) {
  const Graph graph = buildGraph(mesh);
  const float edge_m = meanEdge(mesh);
  const TriangleBins bins(mesh);
  const int vertices = static_cast<int>(mesh.vertices.rows()), count = static_cast<int>(bones.size());
  const auto straight = [&](int vertex, int bone) {
    return distanceToSegment<2>(mesh.vertices.row(vertex).head<2>(), bones[bone].from.head<2>(),
                                bones[bone].to.head<2>());
  };

  struct Front {
    float distance;
    int vertex, bone;
    bool operator>(const Front& other) const {
      if (distance != other.distance) return distance > other.distance;
      return std::pair(vertex, bone) > std::pair(other.vertex, other.bone);
    }
  };
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  BoneDistances way = BoneDistances::Constant(vertices, count, kUnreached);
  const auto reach = [&](int vertex, int bone, float distance) {
    if (distance >= way(vertex, bone)) return;
    way(vertex, bone) = distance;
    fronts.push({distance, vertex, bone});
  };
  for (int b = 0; b < count; ++b) {
    const Eigen::Vector3f along = bones[b].to - bones[b].from;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(along.norm() / std::max(0.7f * edge_m, 1e-6f))), 1, 1000);
    bool seeded = false;
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3f p = bones[b].from + along * (static_cast<float>(k) / static_cast<float>(steps));
      for (const int wall : bins.walls(p)) {
        if (wall < 0) continue;
        for (int corner = 0; corner < 3; ++corner) {
          const int v = mesh.triangles(wall, corner);
          reach(v, b, straight(v, b));
          seeded = true;
        }
      }
    }
    if (seeded) continue;
    // A bone beside the body belongs to what is nearest.
    int nearest = 0;
    for (int v = 1; v < vertices; ++v) {
      if (straight(v, b) < straight(nearest, b)) nearest = v;
    }
    reach(nearest, b, straight(nearest, b));
  }

  while (!fronts.empty()) {
    const Front front = fronts.top();
    fronts.pop();
    if (front.distance > way(front.vertex, front.bone)) continue;
    for (int k = graph.first[front.vertex]; k < graph.first[front.vertex + 1]; ++k) {
      reach(graph.arcs[k].to, front.bone, front.distance + graph.arcs[k].length);
    }
  }
  for (int v = 0; v < vertices; ++v) {
    for (int b = 0; b < count; ++b) {
      float& distance = way(v, b);
      if (distance == kUnreached) continue;
      const float line = straight(v, b);
      distance = line + kPenalty * std::max(0.0f, distance - kDetour * line - edge_m);
    }
  }
  return weightsFromDistances(way, bones, joint_count, edge_m);
}

}  // namespace skel
