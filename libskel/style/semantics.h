// Which action a frame shows, read from its components.
//
// Patent CN102231209A, the semantic term β‖WṼ − Y‖²: solved after U and V.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace skel {

struct SemanticOptions {
  double ridge = 1e-3;  // λ > 0, in units of the squared activations' mean
};

struct Semantics {
  std::vector<std::string> classes;  // r, sorted
  Eigen::MatrixXd rebuilt;           // Ṽ, k×m: V from its r leading eigenvectors with weights >= 0
  Eigen::MatrixXd class_weights;  // W = Y·Ṽᵀ(Ṽ·Ṽᵀ + λI)⁻¹, r×k; a column is a component's class signature
  std::vector<int> predicted;  // of each frame, the row of W·Ṽ that is largest
  double accuracy = 0;         // share of the frames of which that is the class
  double residual = 0;         // ‖WṼ − Y‖²
};

// `activations`: V, k×m, >= 0; `actions`: the class of each of the m frames. Throws UsageError: no frame, a
// frame whose class is empty.
Semantics fitSemantics(const Eigen::MatrixXd& activations, const std::vector<std::string>& actions,
                       const SemanticOptions& options = {});

// Which component of `theirs` (r×k) has the signature of each component of `ours` (r×k): the assignment of
// the least sum of squared differences (Kuhn 1955).
std::vector<int> matchSignatures(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs);

}  // namespace skel
