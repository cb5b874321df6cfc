// The nearest of some vertices, found in a tree of boxes (J. L. Bentley 1975, "Multidimensional binary search
// trees used for associative searching") however unevenly they lie.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace skel {

class VertexTree {
 public:
  // Of these vertices none is looked at before it is added. They must outlive the tree.
  explicit VertexTree(const Eigen::MatrixX3f& vertices);
  void add(int vertex);

  struct Found {
    int vertex = -1;
    float distance_m = std::numeric_limits<float>::infinity();
  };
  // Of those added the nearest to p that is no farther than `limit_m`, and no more than a twentieth
  // farther than the nearest of all: what lies all around p at one distance need not be looked at whole.
  Found nearest(const Eigen::Vector3f& p, float limit_m) const;

 private:
  struct Node {
    Eigen::AlignedBox3f box;
    int first, last;  // of order_
    int below[2];     // nodes; -1 in a leaf
    int above;        // -1 at the top
    int added = 0;    // vertices
  };
  int build(int first, int last, int above);

  const Eigen::MatrixX3f& vertices_;
  std::vector<int> order_;  // vertices by leaf
  std::vector<int> leaf_;   // of each vertex
  std::vector<char> added_;
  std::vector<Node> nodes_;
};

}  // namespace skel
