#include "libskel/skeleton/place_in_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace skel {
namespace {

// The sides of a point that lie behind a triangle, seen along the axes: bit 2·axis below it, 2·axis + 1
// above.
unsigned sidesMet(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& p) {
  unsigned sides = 0;
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
    sides |= 1u << (2 * axis + (at / sum >= p[axis] ? 1 : 0));
  }
  return sides;
}

bool surrounded(unsigned sides) {
  return ((sides & 3) == 3) + ((sides >> 2 & 3) == 3) + ((sides >> 4 & 3) == 3) >= 2;
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
  const std::vector<int> one_group(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  double inside = 0;
  for (const std::vector<int>& around : groupsAround(points, mesh, one_group)) inside += !around.empty();
  return inside / static_cast<double>(points.size());
}

std::vector<std::vector<int>> groupsAround(const std::vector<Eigen::Vector3d>& points,
                                           const TriangleMesh& mesh,
                                           const std::vector<int>& group_of_vertex) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::ArrayX3f at(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) at.row(i) = points[static_cast<std::size_t>(i)].cast<float>();
  std::vector<std::map<int, unsigned>> met(points.size());  // sides by group
  Eigen::ArrayXi within(count);
  const auto between = [](float low, float x, float high) { return int{low <= x} & int{x <= high}; };
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3i corners = mesh.triangles.row(t);
    const Eigen::RowVector3f a = mesh.vertices.row(corners[0]), b = mesh.vertices.row(corners[1]),
                             c = mesh.vertices.row(corners[2]);
    const Eigen::RowVector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    // A line along an axis meets the triangle only where the other two coordinates are between its corners'.
    for (Eigen::Index i = 0; i < count; ++i) {
      within[i] = between(low[0], at(i, 0), high[0]) + between(low[1], at(i, 1), high[1]) +
                  between(low[2], at(i, 2), high[2]);
    }
    if (within.maxCoeff() < 2) continue;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (within[i] < 2) continue;
      const unsigned sides =
          sidesMet({a.transpose().cast<double>(), b.transpose().cast<double>(), c.transpose().cast<double>()},
                   points[static_cast<std::size_t>(i)]);
      if (sides != 0)
        met[static_cast<std::size_t>(i)][group_of_vertex[static_cast<std::size_t>(corners[0])]] |= sides;
    }
  }
  std::vector<std::vector<int>> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto& [group, sides] : met[i])
      if (surrounded(sides)) result[i].push_back(group);
  return result;
}

}  // namespace skel
