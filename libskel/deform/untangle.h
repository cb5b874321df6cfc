// Triangles of a flat mesh that are turned over, turned back.
//
// V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "Foldover-free maps in 50 lines
// of code" (2021): of the map J from rest, Σ area (|J|² + det² J + 1) / det J is least where triangles are
// only turned, and infinite where one is flat. In the denominator stands χ(det J, ε) = (det + √(ε² + det²)) /
// 2, which is positive on both sides and tends to det as ε falls, so that descent leads out of what is
// folded.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace skel {

// A triangle of less than this share of its area at rest counts as turned over.
inline constexpr double kLeastAreaShare = 0.01;

// A point of a mesh, held where it is wanted.
struct MeshHandle {
  std::array<int, 3> vertices;
  std::array<double, 3> shares;  // barycentric

  Eigen::Vector2d of(const Eigen::MatrixX2d& places) const {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 3; ++k) at += shares[k] * places.row(vertices[k]).transpose();
    return at;
  }
};

class Untangler {
 public:
  // `rest`: #V×2, `triangles`: #F×3, none of area 0, all of one orientation.
  Untangler(const Eigen::MatrixX2d& rest, const Eigen::MatrixX3i& triangles,
            const std::vector<MeshHandle>& handles);

  // Moves the corners of what is turned over and those around them, `posed`: #V×2; further ones only where
  // that is not enough. Handles are drawn to `targets`, #H×2. A mesh of which nothing is turned over stays as
  // it is.
  void untangle(Eigen::MatrixX2d& posed, const Eigen::MatrixX2d& targets) const;

 private:
  struct Triangle {
    Eigen::Vector3i corners;
    double area;                            // at rest
    Eigen::Matrix<double, 2, 3> gradients;  // of the function that is 1 at a corner, 0 at the others
  };
  class Patch;

  // det J of each triangle.
  Eigen::VectorXd areaShares(const Eigen::MatrixX2d& posed) const;
  static Eigen::Matrix2d jacobian(const Triangle& triangle, const Eigen::MatrixX2d& posed);

  Eigen::Index vertex_count_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<MeshHandle> handles_;
};

}  // namespace skel
