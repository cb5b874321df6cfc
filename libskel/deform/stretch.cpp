#include "libskel/deform/stretch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "libskel/animation/sample_pose.h"
#include "libskel/deform/skin_vertices.h"

namespace skel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector3d;

constexpr int kMoments = 3;
constexpr Eigen::Index kStep = 4;

// The triangle in its own plane: its edges from the first corner as columns.
Matrix2d flat(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, Eigen::Index t) {
  const auto corner = [&](int k) {
    return Vector3d(vertices.row(mesh.triangles(t, k)).transpose().cast<double>());
  };
  const Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a;
  const double length = std::max(1e-12, u.norm());
  const double along = u.dot(v) / length;
  Matrix2d edges;
  edges << length, along, 0, std::sqrt(std::max(0., v.squaredNorm() - along * along));
  return edges;
}

}  // namespace

std::vector<RestTriangle> restTriangles(const TriangleMesh& mesh, Eigen::Index step) {
  std::vector<RestTriangle> rest;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); t += step) {
    const Matrix2d edges = flat(mesh.vertices, mesh, t);
    const double twice_area = edges.determinant();
    const Matrix2d inverse = std::abs(twice_area) > 1e-12 ? Matrix2d(edges.inverse()) : Matrix2d::Zero();
    rest.push_back({t, twice_area / 2, inverse});
  }
  return rest;
}

double stretchOf(const RestTriangle& rest, const TriangleMesh& mesh, const Eigen::MatrixX3f& posed) {
  if (rest.inverse.isZero(0)) return 1;
  const auto corner = [&](int k) -> Vector3d {
    return posed.row(mesh.triangles(rest.triangle, k)).transpose().cast<double>();
  };
  const Vector3d from = corner(0), u = corner(1) - from, v = corner(2) - from;
  const double p = rest.inverse(0, 0), q = rest.inverse(0, 1), s = rest.inverse(1, 1);  // below is zero
  // The map's columns: along the first edge at rest, and across it.
  const Vector3d along = p * u, across = q * u + s * v;
  const double a = along.squaredNorm(), b = along.dot(across), c = across.squaredNorm();
  return std::sqrt((a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)) / 2);
}

std::vector<ClipStretch> clipStretches(const TriangleMesh& mesh, const Skeleton& skeleton,
                                       const SkinWeights& weights, const std::vector<Clip>& clips) {
  const float height = mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff();
  const std::vector<RestTriangle> rest = restTriangles(mesh, kStep);
  double all = 0;
  for (const RestTriangle& t : rest) all += kMoments * t.area;
  std::vector<ClipStretch> found;
  for (const Clip& clip : clips) {
    ClipStretch& stretch = found.emplace_back();
    stretch.clip = clip.name;
    stretch.by_joint.assign(skeleton.joints.size(), 0);
    for (int moment = 0; moment < kMoments; ++moment) {
      const float time_s = clip.duration_s() * (static_cast<float>(moment) + .5f) / kMoments;
      const Pose pose = samplePose(clip, skeleton, time_s);
      const Eigen::MatrixX3f posed =
          skinVertices(mesh.vertices, weights, posedFromRest(skeleton, pose, height));
      for (const RestTriangle& t : rest) {
        if (stretchOf(t, mesh, posed) <= kFarStretch) continue;
        stretch.share += t.area;
        const Eigen::Index vertex = mesh.triangles(t.triangle, 0);
        for (int k = 0; k < 4; ++k)
          stretch.by_joint[weights.joints(vertex, k)] +=
              t.area * static_cast<double>(weights.weights(vertex, k));
      }
    }
    if (all == 0) continue;
    stretch.share /= all;
    for (double& share : stretch.by_joint) share /= all;
  }
  return found;
}

}  // namespace skel
