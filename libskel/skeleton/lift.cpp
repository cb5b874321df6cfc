// Shu & Yang (2018), mapping to the model: z at mid-depth.
#include "libskel/skeleton/lift.h"

#include <algorithm>
#include <limits>

namespace skel {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double nearestVertexDepth(const TriangleMesh& mesh, const Vector2d& p) {
  Eigen::Index nearest = 0;
  (mesh.vertices.leftCols<2>().cast<double>().rowwise() - p.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return mesh.vertices(nearest, 2);
}

constexpr int kAll = -1;

double middleDepth(const TriangleMesh& mesh, const Vector2d& p, int layer) {
  double front = -std::numeric_limits<double>::infinity(), back = -front;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (layer != kAll && mesh.layer[mesh.triangles(t, 0)] != layer) continue;
    const auto corner = [&](int k) { return mesh.vertices.row(mesh.triangles(t, k)).cast<double>(); };
    const Vector2d a = corner(0).head<2>(), b = corner(1).head<2>(), c = corner(2).head<2>();
    const double area = cross(b - a, c - a);
    if (area == 0) continue;
    const double u = cross(b - p, c - p) / area, v = cross(c - p, a - p) / area, w = 1 - u - v;
    if (u < 0 || v < 0 || w < 0) continue;
    const double z = u * corner(0)(2) + v * corner(1)(2) + w * corner(2)(2);
    front = std::max(front, z);
    back = std::min(back, z);
  }
  return front >= back ? (front + back) / 2 : nearestVertexDepth(mesh, p);
}

}  // namespace

void liftToModel(Skeleton& skeleton, const TriangleMesh& mesh, const std::vector<int>& layers) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    Joint& joint = skeleton.joints[j];
    const Vector2d p = mesh.model_from_image(joint.image);
    joint.position = {p.x(), p.y(),
                      mesh.vertices.rows()
                          ? middleDepth(mesh, p, mesh.layer.size() == 0 || layers.empty() ? kAll : layers[j])
                          : 0};
  }
}

}  // namespace skel
