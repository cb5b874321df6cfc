#include "libskel/mesh/split_seams.h"

#include <array>
#include <map>
#include <numeric>

namespace skel {

SplitMesh splitSeams(const TriangleMesh& mesh) {
  SplitMesh out;
  out.mesh.vertices = mesh.vertices;
  out.mesh.triangles = mesh.triangles;
  out.mesh.uv = mesh.uv;
  out.source.resize(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(out.source.begin(), out.source.end(), 0);
  if (mesh.back_uv.rows() == 0) return out;
  std::vector<char> in_front(out.source.size(), 0);
  for (Eigen::Index t = 0; t < mesh.first_back; ++t)
    for (int k = 0; k < 3; ++k) in_front[mesh.triangles(t, k)] = 1;
  std::vector<int> behind(out.source.size(), -1);
  for (Eigen::Index t = mesh.first_back; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, k);
      if (behind[v] < 0) {
        behind[v] = in_front[v] ? static_cast<int>(out.source.size()) : v;
        if (in_front[v]) out.source.push_back(v);
      }
      out.mesh.triangles(t, k) = behind[v];
    }
  const Eigen::Index count = static_cast<Eigen::Index>(out.source.size());
  out.mesh.vertices.resize(count, 3);
  out.mesh.uv.resize(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int v = out.source[static_cast<std::size_t>(i)];
    out.mesh.vertices.row(i) = mesh.vertices.row(v);
    out.mesh.uv.row(i) = behind[v] == i ? mesh.back_uv.row(v) : mesh.uv.row(v);
  }
  return out;
}

std::optional<TriangleMesh> joinSeams(const TriangleMesh& split) {
  if (split.uv.rows() != split.vertices.rows() || split.back_uv.rows() > 0) return std::nullopt;
  std::map<std::array<float, 3>, int> first;
  std::vector<int> source;
  for (Eigen::Index v = 0; v < split.vertices.rows(); ++v) {
    const auto p = split.vertices.row(v);
    source.push_back(first.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<int>(v)).first->second);
  }
  const auto count = static_cast<Eigen::Index>(first.size());
  if (count == split.vertices.rows()) return std::nullopt;
  TriangleMesh whole;
  whole.vertices = split.vertices;
  whole.triangles = split.triangles;
  whole.uv = split.uv;
  for (Eigen::Index t = 0; t < whole.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      whole.triangles(t, k) = source[static_cast<std::size_t>(split.triangles(t, k))];
  whole.vertices.conservativeResize(count, 3);
  whole.uv.conservativeResize(count, 2);
  whole.back_uv = whole.uv;
  for (Eigen::Index v = count; v < split.vertices.rows(); ++v) {
    const int from = source[static_cast<std::size_t>(v)];
    if (from >= count) return std::nullopt;
    whole.back_uv.row(from) = split.uv.row(v);
  }
  whole.first_back = whole.triangles.rows() / 2;
  const SplitMesh again = splitSeams(whole);
  const bool same = again.source == source && again.mesh.triangles == split.triangles &&
                    again.mesh.vertices == split.vertices && again.mesh.uv == split.uv;
  return same ? std::optional(std::move(whole)) : std::nullopt;
}

}  // namespace skel
