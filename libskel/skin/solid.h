// The inside of a mesh as cubes.
//
// O. Dionne, M. de Lasa, "Geodesic voxel binding for production character meshes" (2013), section 3: cubes
// that the surface passes, and all that cannot be reached from outside. Nothing is asked of the mesh: where
// it is open, the inside is its surface alone; parts that touch or overlap are one body.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

class Solid {
 public:
  // Cubes about as large as the triangles' sides; the mesh has vertices and triangles.
  explicit Solid(const TriangleMesh& mesh);

  float cell_m() const { return cell_m_; }
  int size() const { return static_cast<int>(cells_.size()); }  // solid cubes, numbered from 0
  // The cube that p lies in; -1: outside.
  int at(const Eigen::Vector3f& p) const;
  int nearest(const Eigen::Vector3f& p) const;
  Eigen::Vector3f center(int cube) const;
  // Whether the straight way from a to b stays inside.
  bool sees(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const;

  // The cubes around one, across sides, edges and corners.
  struct Step {
    int to;
    float length_m;
  };
  template <class Visit>
  void forNeighbours(int cube, const Visit& visit) const {
    for (int k = 0; k < 26; ++k) {
      const int to = number_[static_cast<std::size_t>(cells_[static_cast<std::size_t>(cube)] + offsets_[k])];
      if (to >= 0) visit(Step{to, lengths_[k]});
    }
  }

 private:
  bool cellOf(const Eigen::Vector3f& p, int& cell) const;
  void markSurface(const TriangleMesh& mesh, std::vector<char>& kind) const;

  Eigen::Array3f low_;
  float cell_m_ = 1;
  std::array<int, 3> count_{};  // cells along x, y, z, with a border of one that is outside
  std::vector<int> number_;     // of every cell: its cube, -1: outside
  std::vector<int> cells_;      // of every cube
  std::array<int, 26> offsets_{};
  std::array<float, 26> lengths_{};
};

}  // namespace skel
