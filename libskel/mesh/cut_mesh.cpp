// Marching triangles: A. Doi, A. Koide, "An efficient method of triangulating equi-valued surfaces by using
// tetrahedral cells" (1991), in the plane.
#include "libskel/mesh/cut_mesh.h"

#include <algorithm>
#include <map>

#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr double kClearance = 0.1;  // a cut keeps this share of an edge from the edge's ends

}  // namespace

std::vector<CutVertex> cutMesh(PlanarMesh& mesh, const std::vector<double>& level) {
  SKEL_CHECK_EQ(level.size(), mesh.vertices.size());
  const int inner = mesh.inner_count;
  std::vector<CutVertex> cuts;
  std::map<std::pair<int, int>, int> cut_of;
  // The number of the cut of an edge, −1 if it has none.
  const auto cut = [&](int a, int b) {
    if (level[a] > level[b]) std::swap(a, b);
    if (!(level[a] < 0 && level[b] > 0)) return -1;
    const auto [found, is_new] = cut_of.try_emplace({a, b}, static_cast<int>(cuts.size()));
    if (is_new)
      cuts.push_back({a, b, std::clamp(level[a] / (level[a] - level[b]), kClearance, 1 - kClearance)});
    return found->second;
  };
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  // Of the old numbers; cut k is −1 − k until their count is known.
  for (const auto& t : mesh.triangles) {
    const int on[3] = {cut(t[0], t[1]), cut(t[1], t[2]), cut(t[2], t[0])};
    const int count = static_cast<int>(std::count_if(on, on + 3, [](int k) { return k >= 0; }));
    if (count == 0) {
      triangles.push_back(t);
      continue;
    }
    // Turned so that the first edge is cut, and of two the last one: corner 0 is alone.
    int turn = 0;
    while (on[turn] < 0 || (count == 2 && on[(turn + 2) % 3] < 0)) ++turn;
    const int a = t[turn], b = t[(turn + 1) % 3], c = t[(turn + 2) % 3], m = -1 - on[turn];
    if (count == 1) {
      triangles.push_back({a, m, c});
      triangles.push_back({m, b, c});
      continue;
    }
    const int n = -1 - on[(turn + 2) % 3];
    triangles.push_back({a, m, n});
    const auto at = [&](int v) -> Eigen::Vector2d {
      if (v >= 0) return mesh.vertices[v];
      const CutVertex& on_edge = cuts[-1 - v];
      return (1 - on_edge.t) * mesh.vertices[on_edge.a] + on_edge.t * mesh.vertices[on_edge.b];
    };
    if ((at(m) - at(c)).squaredNorm() <= (at(n) - at(b)).squaredNorm()) {
      triangles.push_back({m, b, c}), triangles.push_back({m, c, n});
    } else {
      triangles.push_back({m, b, n}), triangles.push_back({b, c, n});
    }
  }
  if (cuts.empty()) return cuts;
  const int added = static_cast<int>(cuts.size());
  const auto renumbered = [&](int v) { return v < 0 ? inner - 1 - v : v < inner ? v : v + added; };
  std::vector<Eigen::Vector2d> points;
  for (const CutVertex& c : cuts) points.push_back((1 - c.t) * mesh.vertices[c.a] + c.t * mesh.vertices[c.b]);
  mesh.vertices.insert(mesh.vertices.begin() + inner, points.begin(), points.end());
  mesh.inner_count += added;
  for (auto& t : triangles)
    for (int& v : t) v = renumbered(v);
  for (auto& [a, b] : mesh.rim) a = renumbered(a), b = renumbered(b);
  for (CutVertex& c : cuts) c.a = renumbered(c.a), c.b = renumbered(c.b);
  mesh.triangles = std::move(triangles);
  return cuts;
}

}  // namespace skel
