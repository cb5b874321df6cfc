// What must hold for a mesh that skel makes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

struct MeshReport {
  std::string problem;  // the first one found; empty: closed, 2-manifold at edges and vertices, consistently
                        // oriented, outward, every vertex used, no degenerate triangle
  int parts = 0;
  int euler = 0;  // vertices − edges + triangles: 2 − 2·handles for one closed part
};

inline MeshReport checkMesh(const TriangleMesh& mesh) {
  MeshReport report;
  const auto fail = [&](const auto&... words) {
    std::ostringstream text;
    (text << ... << words);
    report.problem = text.str();
    return report;
  };
  const int vertices = static_cast<int>(mesh.vertices.rows()),
            triangles = static_cast<int>(mesh.triangles.rows());
  if (vertices == 0 || triangles == 0) return fail("empty");
  if (!mesh.vertices.allFinite()) return fail("a vertex is not finite");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= vertices)
    return fail("index out of range");

  // For each directed edge the corner after it: `next[v]` holds (to, apex) of the triangles around v.
  std::vector<std::vector<std::pair<int, int>>> next(vertices);
  double volume = 0;
  for (int t = 0; t < triangles; ++t) {
    const Eigen::RowVector3i f = mesh.triangles.row(t);
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return fail("triangle ", t, " names a vertex twice");
    const Eigen::Vector3d a = mesh.vertices.row(f[0]).cast<double>(),
                          b = mesh.vertices.row(f[1]).cast<double>(),
                          c = mesh.vertices.row(f[2]).cast<double>();
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double height = (b - a).cross(c - a).norm() / longest;
    if (!(height > 1e-3 * longest)) return fail("triangle ", t, " is degenerate: ", longest, " by ", height);
    volume += a.dot(b.cross(c)) / 6;
    for (int k = 0; k < 3; ++k) next[f[k]].emplace_back(f[(k + 1) % 3], f[(k + 2) % 3]);
  }
  int edges = 0;
  for (int v = 0; v < vertices; ++v) {
    auto& fan = next[v];
    if (fan.empty()) return fail("vertex ", v, " is in no triangle");
    std::sort(fan.begin(), fan.end());
    edges += static_cast<int>(fan.size());
    // Around a manifold vertex, stepping from one triangle to the next comes back after passing all of them.
    std::size_t passed = 0;
    int at = fan.front().first;
    do {
      const auto found = std::lower_bound(fan.begin(), fan.end(), std::pair(at, -1));
      if (found == fan.end() || found->first != at) return fail("edge ", v, "-", at, " has one triangle");
      if (found + 1 != fan.end() && (found + 1)->first == at)
        return fail("edge ", v, "-", at, " has more than two");
      at = found->second;
      ++passed;
    } while (at != fan.front().first && passed <= fan.size());
    if (passed != fan.size()) return fail("the triangles around vertex ", v, " are no single fan");
  }
  if (!(volume > 0)) return fail("inside out: volume ", volume);
  report.euler = vertices - edges / 2 + triangles;

  std::vector<bool> seen(vertices);
  for (int start = 0; start < vertices; ++start) {
    if (seen[start]) continue;
    ++report.parts;
    std::vector<int> stack{start};
    seen[start] = true;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (const auto& [to, apex] : next[v]) {
        if (!seen[to]) seen[to] = true, stack.push_back(to);
      }
    }
  }
  return report;
}

}  // namespace skel
