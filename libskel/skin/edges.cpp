#include "libskel/skin/edges.h"

#include <algorithm>
#include <numeric>

namespace skel {

Edges edgesOf(int vertices, const Eigen::MatrixX3i& triangles) {
  std::vector<int> start(vertices + 1, 0);
  for (const int v : triangles.reshaped()) start[v + 1] += 2;
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> all(start.back()), next(start.begin(), start.end() - 1);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      all[next[a]++] = b, all[next[b]++] = a;
    }
  }
  Edges edges;
  edges.first.push_back(0);
  edges.to.reserve(all.size() / 2);
  for (int v = 0; v < vertices; ++v) {
    const auto begin = all.begin() + start[v], end = all.begin() + start[v + 1];
    std::sort(begin, end);
    edges.to.insert(edges.to.end(), begin, std::unique(begin, end));
    edges.first.push_back(static_cast<int>(edges.to.size()));
  }
  return edges;
}

}  // namespace skel
