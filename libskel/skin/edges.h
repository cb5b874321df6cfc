// Which vertices are joined by edges.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace skel {

struct Edges {
  std::vector<int> first, to;  // of vertex v: to[first[v]] … to[first[v + 1] - 1], ascending
};

// Of the triangles' sides; `vertices` is more than any index of theirs.
Edges edgesOf(int vertices, const Eigen::MatrixX3i& triangles);

}  // namespace skel
