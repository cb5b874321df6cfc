#include "libskel/mesh/lay_over.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr double kSlope = 0.7;  // of the way from the parts that lie over others down to those that do not

double heightOf(const PlanarMesh& mesh, const Eigen::VectorXd& z, int v) {
  return v < mesh.inner_count ? z[v] : 0;
}

}  // namespace

Relief::Relief(const Vector2d& low, const Vector2d& high, double cell_px) : low_(low), cell_px_(cell_px) {
  const Vector2d cells = ((high - low) / cell_px).array().ceil();
  height_.setZero(static_cast<Eigen::Index>(cells.y()) + 2, static_cast<Eigen::Index>(cells.x()) + 2);
}

void Relief::raise(const PlanarMesh& mesh, const Eigen::VectorXd& z, const std::vector<double>& offset) {
  for (const auto& t : mesh.triangles) {
    Vector2d p[3];
    double height[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = (mesh.vertices[t[k]] - low_) / cell_px_;
      height[k] = heightOf(mesh, z, t[k]) + offset[t[k]];
    }
    const Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    const auto last = [](double value, Eigen::Index count) {
      return std::min(count - 1, static_cast<Eigen::Index>(std::floor(value)));
    };
    for (auto y = static_cast<Eigen::Index>(std::ceil(std::max(0., low.y())));
         y <= last(high.y(), height_.rows()); ++y)
      for (auto x = static_cast<Eigen::Index>(std::ceil(std::max(0., low.x())));
           x <= last(high.x(), height_.cols()); ++x) {
        const Vector2d at(static_cast<double>(x), static_cast<double>(y));
        const double u = cross(p[1] - at, p[2] - at) / area, v = cross(p[2] - at, p[0] - at) / area,
                     w = 1 - u - v;
        if (!(u >= 0 && v >= 0 && w >= 0)) continue;
        height_(y, x) = std::max(height_(y, x), u * height[0] + v * height[1] + w * height[2]);
      }
  }
}

double Relief::at(const Vector2d& p) const {
  const Vector2d cell = (p - low_) / cell_px_;
  if (cell.minCoeff() < 0 || cell.x() > static_cast<double>(height_.cols() - 1) ||
      cell.y() > static_cast<double>(height_.rows() - 1))
    return 0;
  const Eigen::Index x = std::min(static_cast<Eigen::Index>(cell.x()), height_.cols() - 2),
                     y = std::min(static_cast<Eigen::Index>(cell.y()), height_.rows() - 2);
  const double s = cell.x() - static_cast<double>(x), t = cell.y() - static_cast<double>(y);
  return (1 - t) * ((1 - s) * height_(y, x) + s * height_(y, x + 1)) +
         t * ((1 - s) * height_(y + 1, x) + s * height_(y + 1, x + 1));
}

std::vector<double> layOver(const Relief& below, const PlanarMesh& mesh, const Eigen::VectorXd& behind,
                            const FigurePiece& piece) {
  Relief offset = below;
  auto& height = offset.height_;
  height.setZero();
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const Vector2d& p = mesh.vertices[v];
    const auto x = std::clamp<Eigen::Index>(std::lround(p.x()) - piece.box.x0, 0, piece.over.cols() - 1);
    const auto y = std::clamp<Eigen::Index>(std::lround(p.y()) - piece.box.y0, 0, piece.over.rows() - 1);
    if (piece.over(y, x) == 0) continue;
    const double base = below.at(p);
    if (base <= 0) continue;
    const double needed = base + behind[v];
    const Vector2d cell = (p - offset.low_) / offset.cell_px_;
    for (int k = 0; k < 4; ++k) {
      double& there =
          height(static_cast<Eigen::Index>(cell.y()) + k / 2, static_cast<Eigen::Index>(cell.x()) + k % 2);
      there = std::max(there, needed);
    }
  }
  // The upper envelope of cones on all points, by chamfer steps there and back.
  const double straight = kSlope * offset.cell_px_, across = straight * std::sqrt(2.0);
  const Eigen::Index rows = height.rows(), columns = height.cols();
  const auto lift = [&](Eigen::Index y, Eigen::Index x, Eigen::Index v, Eigen::Index u, double fall) {
    if (v >= 0 && u >= 0 && v < rows && u < columns)
      height(y, x) = std::max(height(y, x), height(v, u) - fall);
  };
  for (Eigen::Index y = 0; y < rows; ++y)
    for (Eigen::Index x = 0; x < columns; ++x) {
      lift(y, x, y, x - 1, straight), lift(y, x, y - 1, x, straight);
      lift(y, x, y - 1, x - 1, across), lift(y, x, y - 1, x + 1, across);
    }
  for (Eigen::Index y = rows; y-- > 0;)
    for (Eigen::Index x = columns; x-- > 0;) {
      lift(y, x, y, x + 1, straight), lift(y, x, y + 1, x, straight);
      lift(y, x, y + 1, x + 1, across), lift(y, x, y + 1, x - 1, across);
    }
  std::vector<double> result;
  for (const Vector2d& p : mesh.vertices) result.push_back(offset.at(p));
  return result;
}

}  // namespace skel
