#include "libskel/skin/vertex_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace skel {
namespace {

constexpr int kLeaf = 8;          // vertices
constexpr float kNearly2 = 1.1f;  // of a squared distance

}  // namespace

VertexTree::VertexTree(const Eigen::MatrixX3f& vertices)
    : vertices_(vertices), order_(vertices.rows()), leaf_(vertices.rows()), added_(vertices.rows(), 0) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()), -1);
}

int VertexTree::build(int first, int last, int above) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, first, last, {-1, -1}, above});
  Eigen::AlignedBox3f box;
  for (int i = first; i < last; ++i) box.extend(vertices_.row(order_[i]).transpose());
  nodes_[index].box = box;
  if (last - first <= kLeaf) {
    for (int i = first; i < last; ++i) leaf_[order_[i]] = index;
    return index;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
    return std::pair(vertices_(a, axis), a) < std::pair(vertices_(b, axis), b);
  });
  const int left = build(first, middle, index), right = build(middle, last, index);
  nodes_[index].below[0] = left, nodes_[index].below[1] = right;
  return index;
}

void VertexTree::add(int vertex) {
  if (std::exchange(added_[vertex], 1)) return;
  for (int node = leaf_[vertex]; node >= 0; node = nodes_[node].above) ++nodes_[node].added;
}

VertexTree::Found VertexTree::nearest(const Eigen::Vector3f& p, float limit_m) const {
  Found found;
  float best2 = limit_m * limit_m;
  // The nearer half is looked at first.
  std::array<std::pair<float, int>, 64> waiting;  // squared distance of the box, node; halves are even
  int count = 0;
  if (!nodes_.empty() && nodes_[0].added > 0)
    waiting[count++] = {nodes_[0].box.squaredExteriorDistance(p), 0};
  while (count > 0) {
    const auto [box2, index] = waiting[--count];
    if (box2 > best2 || (found.vertex >= 0 && box2 * kNearly2 >= best2)) continue;
    const Node& node = nodes_[index];
    if (node.below[0] < 0) {
      for (int i = node.first; i < node.last; ++i) {
        const int v = order_[i];
        if (!added_[v]) continue;
        const float distance2 = (vertices_.row(v).transpose() - p).squaredNorm();
        if (distance2 > best2 || (found.vertex >= 0 && distance2 == best2)) continue;
        best2 = distance2;
        found.vertex = v;
      }
      continue;
    }
    std::pair<float, int> halves[2];
    for (int k = 0; k < 2; ++k)
      halves[k] = {nodes_[node.below[k]].box.squaredExteriorDistance(p), node.below[k]};
    if (halves[0].first < halves[1].first) std::swap(halves[0], halves[1]);
    for (const auto& half : halves)
      if (nodes_[half.second].added > 0) waiting[count++] = half;
  }
  if (found.vertex >= 0) found.distance_m = std::sqrt(best2);
  return found;
}

}  // namespace skel
