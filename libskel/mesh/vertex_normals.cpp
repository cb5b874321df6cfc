#include "libskel/mesh/vertex_normals.h"

#include <Eigen/Geometry>

namespace skel {

Eigen::MatrixX3f vertexNormals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles) {
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Points sums = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector3i v = triangles.row(t);
    const Eigen::RowVector3d a = vertices.row(v[0]).cast<double>();
    const Eigen::RowVector3d b = vertices.row(v[1]).cast<double>();
    const Eigen::RowVector3d c = vertices.row(v[2]).cast<double>();
    const Eigen::RowVector3d twice_area = (b - a).cross(c - a);
    for (int i = 0; i < 3; ++i) sums.row(v[i]) += twice_area;
  }
  Eigen::MatrixX3f normals(sums.rows(), 3);
  for (Eigen::Index i = 0; i < sums.rows(); ++i) {
    const double length = sums.row(i).norm();
    normals.row(i) =
        length > 1e-30 ? (sums.row(i) / length).cast<float>().eval() : Eigen::RowVector3f(0, 0, 1);
  }
  return normals;
}

}  // namespace skel
