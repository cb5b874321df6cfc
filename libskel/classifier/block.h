// How the net is computed, here and in training: blocks of samples, one after the other, each layer for the
// whole block at once. A block's size is fixed and the sigmoid is our own, so that no result depends on the
// number of samples, the number of threads, the cache or the C library of the machine.
#pragma once

#include <Eigen/Core>

namespace skel {

inline constexpr int kBlockSize = 64;

// A sample a row, a unit a column.
template <class Scalar>
using Block = Eigen::Array<Scalar, kBlockSize, Eigen::Dynamic>;

// outputs.col(j) = sigmoid(inputs · weights.row(j) + biases[j]) for the first weights.rows() columns of
// outputs. weights: outputs × inputs.
void forwardBlock(const Eigen::MatrixXf& weights, const Eigen::VectorXf& biases, const Block<float>& inputs,
                  Block<float>& outputs);

}  // namespace skel
