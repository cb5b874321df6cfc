// Distance measured inside the body, along the mesh as seen from the front.
//
// The bones of a drawn figure lie in one plane and its body is deep about them, so that the way inside the
// body from a bone to a vertex is the way in that plane, depth left out. Ways follow the mesh's edges
// (Dijkstra 1959, from all bones at once), which know every gap between limbs; they start at the two walls
// before and behind each point of the bone. A way along edges is up to 8 % too long: where it is hardly
// longer than the straight line, nothing lies between, and the straight line counts.
//
// A bone is a row of balls, each as large as the body is deep there, and its distance is a ball's power, d² −
// r²: the flank of a fat body is the body's, however near the upper arm may be.
//
// Skeletons that reach far into the depth, those of models of a user's own, go by volumetric.h.
#include "libskel/skin/methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "libskel/core/segment.h"
#include "libskel/skin/fronts.h"
#include "libskel/skin/volumetric.h"

namespace skel {
namespace {

// What a way along edges, with the two diagonals of each quad, can be longer than the straight line.
constexpr float kDetour = 1.12f;
// How much a way around something counts beyond its own length.
constexpr float kPenalty = 2;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::int64_t kMostSquares = 64;  // that a triangle touches, on average

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
    // Of a user's own model, each triangle may touch most squares.
    for (;; cell_ *= 2) {
      columns_ = static_cast<int>(size.x() / cell_) + 1;
      rows_ = static_cast<int>(size.y() / cell_) + 1;
      std::int64_t touched = 0;
      for (int t = 0; t < mesh.triangles.rows(); ++t) touched += squares(t).area();
      if (touched <= kMostSquares * (mesh.triangles.rows() + 1000)) break;
    }
    first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    forEach([&](int bin, int) { ++first_[bin + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    triangles_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    forEach([&](int bin, int triangle) { triangles_[next[bin]++] = triangle; });
  }

  struct Wall {
    int triangle = -1;  // -1: there is none
    float distance = kFar;
  };
  // The triangles just before and just behind a point.
  std::array<Wall, 2> walls(const Eigen::Vector3f& p) const {
    std::array<Wall, 2> result;
    const Eigen::Vector2f at = (p.head<2>() - low_) / cell_;
    if (at.minCoeff() < 0 || at.x() >= static_cast<float>(columns_) || at.y() >= static_cast<float>(rows_))
      return result;
    const int bin = static_cast<int>(at.y()) * columns_ + static_cast<int>(at.x());
    for (std::size_t k = first_[bin]; k < first_[bin + 1]; ++k) {
      const Eigen::RowVector3i t = mesh_.triangles.row(triangles_[k]);
      const Eigen::Vector3f a = mesh_.vertices.row(t[0]), b = mesh_.vertices.row(t[1]),
                            c = mesh_.vertices.row(t[2]);
      const auto cross = [&](const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
        return (u.x() - p.x()) * (v.y() - p.y()) - (v.x() - p.x()) * (u.y() - p.y());
      };
      const float wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), sum = wa + wb + wc;
      if (sum == 0 || wa * sum < 0 || wb * sum < 0 || wc * sum < 0) continue;
      const float z = (wa * a.z() + wb * b.z() + wc * c.z()) / sum - p.z();
      Wall& wall = result[z >= 0 ? 0 : 1];
      if (std::abs(z) < wall.distance) wall = {triangles_[k], std::abs(z)};
    }
    return result;
  }

 private:
  struct Squares {
    int x0, y0, x1, y1;  // the last ones included
    std::int64_t area() const { return std::int64_t(x1 - x0 + 1) * (y1 - y0 + 1); }
  };
  Squares squares(int triangle) const {
    Eigen::Array2f low = Eigen::Array2f::Constant(kFar), high = -low;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh_.triangles(triangle, k);
      const Eigen::Array2f p =
          (Eigen::Array2f(mesh_.vertices(v, 0), mesh_.vertices(v, 1)) - low_.array()) / cell_;
      low = low.min(p), high = high.max(p);
    }
    return {static_cast<int>(low.x()), static_cast<int>(low.y()),
            std::min(static_cast<int>(high.x()), columns_ - 1),
            std::min(static_cast<int>(high.y()), rows_ - 1)};
  }

  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      const Squares touched = squares(t);
      for (int y = touched.y0; y <= touched.y1; ++y) {
        for (int x = touched.x0; x <= touched.x1; ++x) visit(y * columns_ + x, t);
      }
    }
  }

  const TriangleMesh& mesh_;
  Eigen::Vector2f low_;
  float cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::size_t> first_;  // of a square's triangles
  std::vector<int> triangles_;
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

// What the body is like along a bone.
struct Profile {
  std::vector<Eigen::Vector2f> points;  // at equal steps, at least two
  std::vector<float> depth2;            // square of half the body's depth there, m²; 0 outside the body
  float deepest = 0;                    // m

  struct Ball {
    float distance, depth2;
  };
  // The ball of the bone that has the least power with respect to p. Between the points depth2 is linear, and
  // the power thus quadratic.
  Ball nearest(const Eigen::Vector2f& p) const {
    Ball best{kFar, 0};
    float least = kFar;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Eigen::Vector2f along = points[i + 1] - points[i];
      const float length2 = along.squaredNorm(), rise = depth2[i + 1] - depth2[i];
      const float t =
          length2 > 0 ? std::clamp(((p - points[i]).dot(along) + 0.5f * rise) / length2, 0.0f, 1.0f) : 0.0f;
      const float distance2 = (points[i] + t * along - p).squaredNorm(), depth = depth2[i] + t * rise;
      if (distance2 - depth < least) least = distance2 - depth, best = {distance2, depth};
    }
    best.distance = std::sqrt(best.distance);
    return best;
  }
};

}  // namespace

JointWeights geodesicWeights(const SkinInput& input) {
  const TriangleMesh& mesh = input.mesh;
  const std::vector<Bone>& bones = input.bones;
  if (!nearlyFlat(bones)) return volumetricWeights(input);
  const Graph graph = buildGraph(mesh);
  const float edge_m = meanEdge(mesh);
  const TriangleBins bins(mesh);
  const int vertices = static_cast<int>(mesh.vertices.rows()), count = static_cast<int>(bones.size());
  const auto inPlane = [&](int vertex) {
    return Eigen::Vector2f(mesh.vertices(vertex, 0), mesh.vertices(vertex, 1));
  };

  // Of the mesh and the bones, which may lie far from it.
  Eigen::Array3f low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  for (const Bone& bone : bones) {
    low = low.min(bone.from.array()).min(bone.to.array()),
    high = high.max(bone.from.array()).max(bone.to.array());
  }
  const float size = (high - low).maxCoeff();
  Fronts fronts(std::max({0.5f * edge_m, 1e-4f * size, 1e-12f}));
  BoneDistances way = BoneDistances::Constant(vertices, count, kFar);
  const auto reach = [&](int vertex, int bone, float distance) {
    if (distance >= way(vertex, bone)) return;
    way(vertex, bone) = distance;
    fronts.push({distance, vertex, bone});
  };
  std::vector<Profile> profiles(count);
  for (int b = 0; b < count; ++b) {
    const Eigen::Vector3f along = bones[b].to - bones[b].from;
    // So many points that none of the triangles before and behind the bone is passed over.
    const int pieces = std::clamp(static_cast<int>(along.norm() / std::max(4 * edge_m, 1e-6f)), 1, 12);
    const int steps =
        pieces *
        std::clamp(static_cast<int>(along.norm() / std::max(0.7f * edge_m * pieces, 1e-6f)) + 1, 1, 50);
    Profile& profile = profiles[b];
    bool seeded = false;
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3f p = bones[b].from + along * (static_cast<float>(k) / static_cast<float>(steps));
      const std::array<TriangleBins::Wall, 2> walls = bins.walls(p);
      for (const TriangleBins::Wall& wall : walls) {
        if (wall.triangle < 0) continue;
        for (int corner = 0; corner < 3; ++corner) {
          const int v = mesh.triangles(wall.triangle, corner);
          reach(
              v, b,
              distanceToSegment<Eigen::Vector2f>(inPlane(v), bones[b].from.head<2>(), bones[b].to.head<2>()));
          seeded = true;
        }
      }
      if (k % (steps / pieces) != 0) continue;
      const bool within = walls[0].triangle >= 0 && walls[1].triangle >= 0;
      const float depth = within ? 0.5f * (walls[0].distance + walls[1].distance) : 0;
      profile.points.push_back(p.head<2>());
      profile.depth2.push_back(depth * depth);
      profile.deepest = std::max(profile.deepest, depth);
    }
    if (seeded) continue;
    // A bone beside the body belongs to what is nearest.
    int nearest = 0;
    for (int v = 1; v < vertices; ++v) {
      if (profile.nearest(inPlane(v)).distance < profile.nearest(inPlane(nearest)).distance) nearest = v;
    }
    reach(nearest, b, profile.nearest(inPlane(nearest)).distance);
  }

  // A way so much longer than the first that came brings no weight any more, nor does any that goes on from
  // it.
  std::vector<float> first2(vertices, kFar), spare2(count);  // m²
  for (int b = 0; b < count; ++b) {
    const float spare = reachBeyondJoint(2 * profiles[b].deepest, edge_m);
    spare2[b] = spare * spare;
  }
  const auto useless = [&](int vertex, int bone, float distance) {
    const float beyond = distance - edge_m;
    return beyond > 0 && beyond * beyond > kDetour * kDetour * (first2[vertex] + spare2[bone]);
  };
  for (Fronts::Front front; fronts.pop(front);) {
    if (front.distance > way(front.place, front.bone)) continue;
    first2[front.place] = std::min(first2[front.place], front.distance * front.distance);
    if (useless(front.place, front.bone, front.distance)) continue;
    for (int k = graph.first[front.place]; k < graph.first[front.place + 1]; ++k) {
      const int to = graph.arcs[k].to;
      const float distance = front.distance + graph.arcs[k].length;
      if (distance < way(to, front.bone) && !useless(to, front.bone, distance))
        reach(to, front.bone, distance);
    }
  }

  const auto reaches = [&](Eigen::Index v, std::vector<BoneReach>& row) {
    const Eigen::Vector2f here = inPlane(static_cast<int>(v));
    for (int b = 0; b < count; ++b) {
      if (way(v, b) == kFar) continue;
      const Profile::Ball ball = profiles[b].nearest(here);
      const float around = std::max(0.0f, way(v, b) - kDetour * ball.distance - edge_m);
      const float distance = ball.distance + kPenalty * around;
      row[b] = {distance * distance, distance * distance - ball.depth2,
                reachBeyondJoint(std::sqrt(ball.depth2), edge_m)};
    }
  };
  return weightsFromReaches(vertices, bones, input.jointCount(), reaches);
}

}  // namespace skel
