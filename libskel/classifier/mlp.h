// Stage 4: the small net that tells head, body, hand and leg candidates apart. Shu & Yang (2018): 3-4-4-2,
// sigmoid, two outputs that encode the class in two bits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "libskel/skeleton/joint_class.h"

namespace skel {

// The two bits that the outputs are trained to give.
inline constexpr std::array<std::array<int, 2>, kJointClassCount> kJointClassCodes = {
    {{0, 0}, {0, 1}, {1, 0}, {1, 1}}};

struct MlpLayer {
  Eigen::MatrixXf weights;  // outputs × inputs
  Eigen::VectorXf biases;   // outputs
};

// A multi-layer perceptron with a sigmoid after every layer.
struct Mlp {
  std::vector<MlpLayer> layers;

  std::vector<int> sizes() const;  // e.g. 3, 4, 4, 2
};

// Rows of samples in, rows of outputs in (0, 1) out: N×inputs → N×outputs.
Eigen::MatrixXf evaluate(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXf>& samples);

using Features = Eigen::Matrix<float, Eigen::Dynamic, 3>;            // N×3: x, y, D, each in [0, 1]
using ClassProbabilities = Eigen::Matrix<float, Eigen::Dynamic, 4>;  // N×4, rows sum to 1

// P(class) = product of its bits' probabilities. `mlp` must be 3-…-2.
ClassProbabilities classify(const Mlp& mlp, const Features& features);

}  // namespace skel
