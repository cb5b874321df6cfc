// The inverted hull: J. Rossignac, M. van Emmerik, "Hidden contours on a frame-buffer" (1992); R. Raskar,
// M. Cohen, "Image precision silhouette edges" (1999).
#include "libskel/mesh/ink_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libskel/mesh/outline_band.h"
#include "libskel/mesh/vertex_normals.h"

namespace skel {
namespace {

constexpr double kInked = 0.6;        // of the rim: a figure with less of a line has none
constexpr double kMostWidth = 0.012;  // of the figure's long side
constexpr float kInPlane = 0.4f;      // of the line's width: what is added to that of the front
constexpr float kBehind = 2;          // widths from what the hull surrounds
// Of the cosine between the normal and the line of sight: what looks away by more is behind what it
// surrounds.
constexpr float kCovered = 0.9f;

template <class Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

InkLine inkLine(const Image& image, const std::vector<OutlineSample>& rim, double long_px, double m_per_px) {
  std::vector<double> widths;
  std::vector<float> rgb[3];
  for (const OutlineSample& sample : rim) {
    if (sample.width_px == 0) continue;
    widths.push_back(sample.width_px);
    const Eigen::Vector2d p = sample.point + sample.width_px / 2 * sample.inwards;
    const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.width - 1),
              y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.height - 1);
    for (int k = 0; k < 3; ++k) rgb[k].push_back(image.pixel(x, y)[k]);
  }
  if (rim.empty() || static_cast<double>(widths.size()) < kInked * static_cast<double>(rim.size())) return {};
  return {static_cast<float>(std::min(median(widths), kMostWidth * long_px) * m_per_px),
          {median(rgb[0]), median(rgb[1]), median(rgb[2])}};
}

Eigen::VectorXf inkReach(const TriangleMesh& mesh) {
  if (!(mesh.ink.width_m > 0)) return {};
  const Eigen::MatrixX3f normals = vertexNormals(mesh.vertices, mesh.triangles);
  return mesh.ink.width_m * normals.col(2).cwiseAbs().cwiseMax(kInPlane);
}

InkHull inkHull(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles,
                const Eigen::MatrixX3f& normals, const Eigen::VectorXf& reach_m, const Eigen::Vector3f& eye) {
  const float behind = kBehind * reach_m.maxCoeff();
  InkHull hull{Eigen::MatrixX3f(vertices.rows(), 3), Eigen::MatrixX3i(triangles.rows(), 3)};
  std::vector<bool> covered(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::RowVector3f sight = vertices.row(v) + reach_m[v] * normals.row(v) - eye.transpose();
    const float distance = std::max(sight.norm(), 1e-6f);
    hull.vertices.row(v) = eye.transpose() + sight * (1 + behind / distance);
    covered[static_cast<std::size_t>(v)] = normals.row(v).dot(sight) > kCovered * distance;
  }
  Eigen::Index count = 0;
  for (const auto& t : triangles.rowwise()) {
    if (covered[static_cast<std::size_t>(t[0])] && covered[static_cast<std::size_t>(t[1])] &&
        covered[static_cast<std::size_t>(t[2])])
      continue;
    const Eigen::RowVector3f a = hull.vertices.row(t[0]), b = hull.vertices.row(t[1]),
                             c = hull.vertices.row(t[2]);
    if ((b - a).cross(c - a).dot(a - eye.transpose()) > 0) hull.triangles.row(count++) << t[0], t[2], t[1];
  }
  hull.triangles.conservativeResize(count, Eigen::NoChange);
  return hull;
}

}  // namespace skel
