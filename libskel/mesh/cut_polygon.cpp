// Ear clipping. G. Meisters, "Polygons have ears" (1975): a corner is an ear when the triangle with its two
// neighbours lies in the polygon, and cutting one off leaves a polygon that has others.
#include "libskel/mesh/cut_polygon.h"

#include <Eigen/Geometry>
#include <cmath>

#include "libskel/core/check.h"

namespace skel {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// The polygon as seen against its normal: it turns to the left.
std::vector<Vector2d> flattened(const std::vector<Eigen::Vector3f>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = corners[0].cast<double>();
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    normal += (corners[k].cast<double>() - origin).cross(corners[k + 1].cast<double>() - origin);
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  std::vector<Vector2d> result;
  for (const Eigen::Vector3f& corner : corners) {
    const Eigen::Vector3d p = corner.cast<double>();
    result.emplace_back(normal[axis] < 0 ? -p[x] : p[x], p[y]);
  }
  return result;
}

}  // namespace

std::vector<std::array<int, 3>> cutPolygon(const std::vector<Eigen::Vector3f>& corners) {
  const int count = static_cast<int>(corners.size());
  SKEL_CHECK(count >= 3);
  const std::vector<Vector2d> at = flattened(corners);
  std::vector<int> before(count), after(count);  // among the corners that are left
  for (int k = 0; k < count; ++k) before[k] = (k + count - 1) % count, after[k] = (k + 1) % count;
  const auto sharp = [&](int k) { return cross(at[before[k]], at[k], at[after[k]]) > 0; };
  const auto isEar = [&](int k) {
    if (!sharp(k)) return false;
    const Vector2d &a = at[before[k]], &b = at[k], &c = at[after[k]];
    for (int other = after[after[k]]; other != before[k]; other = after[other]) {
      const Vector2d& p = at[other];
      if (sharp(other) || p == a || p == b || p == c) continue;
      if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
    }
    return true;
  };

  std::vector<std::array<int, 3>> triangles;
  std::vector<bool> refused(count, false);  // no ear, as long as its neighbours stay
  for (int k = 1, left = count, in_vain = 0; left >= 3;) {
    // Where the polygon crosses itself, there may be no ear.
    const bool cut = in_vain >= left || (!refused[k] && isEar(k));
    const int next = after[k];
    if (!cut) {
      refused[k] = true;
      ++in_vain;
    } else {
      triangles.push_back({before[k], k, next});
      after[before[k]] = next, before[next] = before[k];
      refused[before[k]] = refused[next] = false;
      --left;
      in_vain = 0;
    }
    k = next;
  }
  return triangles;
}

}  // namespace skel
