#include "libskel/skeleton/place_in_mesh.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace skel {
namespace {

// Where the lines through p along the axes meet the triangle: before or behind p.
void meet(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& p,
          std::array<std::array<bool, 2>, 3>& met) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double weights[3], sum = 0, at = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = triangle[(k + 1) % 3], &b = triangle[(k + 2) % 3];
      weights[k] = (a[u] - p[u]) * (b[v] - p[v]) - (b[u] - p[u]) * (a[v] - p[v]);
      sum += weights[k];
      at += weights[k] * triangle[k][axis];
    }
    if (sum == 0 || weights[0] * sum < 0 || weights[1] * sum < 0 || weights[2] * sum < 0) continue;
    met[axis][at / sum >= p[axis] ? 1 : 0] = true;
  }
}

}  // namespace

Skeleton yUpFromZUp(Skeleton skeleton) {
  const auto turned = [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.z(), -p.y()); };
  for (Joint& joint : skeleton.joints) {
    joint.position = turned(joint.position);
    if (joint.tail) joint.tail = turned(*joint.tail);
  }
  return skeleton;
}

double shareInside(const Skeleton& skeleton, const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const Joint& joint : skeleton.joints) {
    if (joint.tail) {
      points.push_back(0.5 * (joint.position + *joint.tail));
    } else if (joint.parent > 0) {
      points.push_back(0.5 * (joint.position + skeleton.joints[joint.parent].position));
    }
  }
  if (points.empty()) points.push_back(skeleton.joints[0].position);
  std::vector<std::array<std::array<bool, 2>, 3>> met(points.size());
  for (auto& of_point : met)
    for (auto& of_axis : of_point) of_axis = {false, false};
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<Eigen::Vector3d, 3> triangle;
    for (int k = 0; k < 3; ++k) triangle[k] = mesh.vertices.row(mesh.triangles(t, k)).cast<double>();
    const Eigen::Array3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]),
                         high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto within = (points[i].array() >= low && points[i].array() <= high).cast<int>();
      if (within.sum() >= 2) meet(triangle, points[i], met[i]);
    }
  }
  int inside = 0;
  for (const auto& of_point : met) {
    int axes = 0;
    for (const auto& of_axis : of_point) axes += of_axis[0] && of_axis[1];
    inside += axes >= 2;
  }
  return static_cast<double>(inside) / static_cast<double>(points.size());
}

}  // namespace skel
