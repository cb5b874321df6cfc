// Vertices at the same place.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace skel {

// Seams of textures, and sheets that were never joined, have several vertices at one place.
class Welding {
 public:
  explicit Welding(const Eigen::MatrixX3f& vertices);

  int count() const { return static_cast<int>(vertices_.size()); }
  // Places are numbered from 0 in the order of their first vertices.
  int place(int vertex) const { return places_[static_cast<std::size_t>(vertex)]; }
  // The first vertex at a place.
  int vertex(int place) const { return vertices_[static_cast<std::size_t>(place)]; }

 private:
  std::vector<int> places_, vertices_;
};

}  // namespace skel
