// Non-negative sparse coding: poses as sums of few parts.
//
// P. Hoyer, "Non-negative sparse coding" (2002), §3; patent CN102231209A uses the same updates.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace skel {

struct SparseCodingOptions {
  int components = 8;      // k, at least 1
  double sparsity = 0.01;  // α >= 0, in units of the entries of X
  int max_iterations = 500;
  double tolerance = 1e-7;  // stops where an iteration lowers the objective by less than this share of it
  int restarts = 3;         // from other beginnings; the best is kept
  std::uint64_t seed = 1;
  std::function<void()> on_iteration = {};  // after each; may be empty

  // At most, of all beginnings.
  std::size_t iterations() const { return std::size_t(std::max(1, restarts)) * std::size_t(max_iterations); }
};

// X ≈ U·V.
struct SparseCoding {
  Eigen::MatrixXd basis;        // U, n×k, >= 0, columns of length 1
  Eigen::MatrixXd activations;  // V, k×m, >= 0
  std::vector<double> objectives;  // ½‖X − UV‖² + α ΣV before the first iteration and after each; never rises
  double error = 0;                // ‖X − UV‖ / ‖X‖; 0 if X is 0
};

// `data`: X, n×m, n and m at least 1, finite, >= 0. Does not depend on the order of its columns but for
// rounding. Components are sorted by their share in the whole, largest first. Throws UsageError: X is empty,
// holds what is no number or a negative one; no component, a negative sparsity.
SparseCoding sparseCoding(const Eigen::MatrixXd& data, const SparseCodingOptions& options = {});

// V for a given U: the multiplicative update alone. `start`, k×m or empty, is where it begins.
Eigen::MatrixXd activationsFor(const Eigen::MatrixXd& data, const Eigen::MatrixXd& basis, double sparsity,
                               int iterations, Eigen::MatrixXd start = {});

}  // namespace skel
