#include "libskel/skin/smooth.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "libskel/skin/edges.h"
#include "libskel/skin/welding.h"

namespace skel {

void smoothWeights(const TriangleMesh& mesh, int rounds, JointWeights& weights) {
  const Welding welding(mesh.vertices);
  Eigen::MatrixX3i triangles = mesh.triangles;
  for (int& corner : triangles.reshaped()) corner = welding.place(corner);
  const Edges edges = edgesOf(welding.count(), triangles);
  JointWeights now(welding.count(), weights.cols()), next = now;
  for (int i = 0; i < welding.count(); ++i) {
    const auto row = weights.row(welding.vertex(i));
    now.row(i) = row / row.sum();
  }
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i < welding.count(); ++i) {
      const int begin = edges.first[i], end = edges.first[i + 1];
      next.row(i) = now.row(i);
      if (begin == end) continue;
      next.row(i) *= static_cast<float>(end - begin);
      for (int k = begin; k < end; ++k) next.row(i) += now.row(edges.to[k]);
      next.row(i) *= 0.5f / static_cast<float>(end - begin);
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

void packRow(const JointWeights& weights, Eigen::Index v, SkinWeights& result) {
  std::array<int, 4> order{};
  std::size_t count = 0;
  for (int joint = 0; joint < weights.cols() && count < order.size(); ++joint)
    if (weights(v, joint) > 0) order[count++] = joint;
  std::stable_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                   [&](int a, int b) { return weights(v, a) > weights(v, b); });
  result.joints.row(v).setZero();
  result.weights.row(v).setZero();
  for (std::size_t k = 0; k < count; ++k) {
    result.joints(v, static_cast<Eigen::Index>(k)) = static_cast<std::uint16_t>(order[k]);
    result.weights(v, static_cast<Eigen::Index>(k)) = weights(v, order[k]);
  }
}

SkinWeights packWeights(const JointWeights& weights) {
  SkinWeights result;
  result.joints.resize(weights.rows(), 4);
  result.weights.resize(weights.rows(), 4);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) packRow(weights, v, result);
  return result;
}

JointWeights unpackWeights(const SkinWeights& weights, int joint_count) {
  JointWeights rows = JointWeights::Zero(weights.joints.rows(), joint_count);
  for (Eigen::Index v = 0; v < rows.rows(); ++v)
    for (int k = 0; k < 4; ++k) rows(v, weights.joints(v, k)) += weights.weights(v, k);
  return rows;
}

}  // namespace skel
