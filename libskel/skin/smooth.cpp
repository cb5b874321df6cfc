#include "libskel/skin/smooth.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "libskel/skin/welding.h"

namespace skel {

void smoothWeights(const TriangleMesh& mesh, int rounds, JointWeights& weights) {
  const Welding welding(mesh.vertices);
  std::vector<std::pair<int, int>> links;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = welding.place(mesh.triangles(t, k)), b = welding.place(mesh.triangles(t, (k + 1) % 3));
      if (a != b) links.insert(links.end(), {{a, b}, {b, a}});
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  JointWeights now(welding.count(), weights.cols()), next;
  for (int i = 0; i < welding.count(); ++i)
    now.row(i) = weights.row(welding.vertex(i)) / weights.row(welding.vertex(i)).sum();
  for (int round = 0; round < rounds; ++round) {
    next = now;
    for (auto link = links.begin(); link != links.end();) {
      const auto begin = link;
      next.row(begin->first).setZero();
      for (; link != links.end() && link->first == begin->first; ++link)
        next.row(begin->first) += now.row(link->second);
      next.row(begin->first) =
          0.5f * now.row(begin->first) + next.row(begin->first) * (0.5f / static_cast<float>(link - begin));
    }
    now.swap(next);
  }
  for (Eigen::Index v = 0; v < weights.rows(); ++v)
    weights.row(v) = now.row(welding.place(static_cast<int>(v)));
}

void keepHeaviest(int count, JointWeights& weights) {
  std::vector<std::pair<float, int>> order;
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    auto row = weights.row(v);
    order.clear();
    for (int joint = 0; joint < row.size(); ++joint)
      if (row[joint] > 0) order.emplace_back(-row[joint], joint);
    if (static_cast<int>(order.size()) > count) {
      std::nth_element(order.begin(), order.begin() + count, order.end());
      for (auto other = order.begin() + count; other != order.end(); ++other) row[other->second] = 0;
    }
    row /= row.sum();
  }
}

}  // namespace skel
