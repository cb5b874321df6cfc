#include "libskel/classifier/block.h"

#include "libskel/classifier/lanes.h"
#include "libskel/classifier/sigmoid.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr int kAtOnce = 4;

template <class Scalar>
SKEL_INLINE void forward(Eigen::Index inputs, Eigen::Index outputs, const Scalar* weights,
                         const Scalar* biases, const Scalar* input, Scalar* output) {
  constexpr int kLanes = kLaneCount<Scalar>;
  for (Eigen::Index j = 0; j < outputs; ++j)
    for (int s = 0; s < kBlockSize; s += kAtOnce * kLanes) {
      Lanes<Scalar> sums[kAtOnce];
      for (auto& sum : sums) sum = Lanes<Scalar>{} + biases[j];
      for (Eigen::Index i = 0; i < inputs; ++i) {
        const Lanes<Scalar> weight = Lanes<Scalar>{} + weights[i * outputs + j];
#pragma GCC unroll 8
        for (int c = 0; c < kAtOnce; ++c) sums[c] += weight * load(input + i * kBlockSize + s + c * kLanes);
      }
      sigmoidInPlace(sums);
#pragma GCC unroll 8
      for (int c = 0; c < kAtOnce; ++c) store(output + j * kBlockSize + s + c * kLanes, sums[c]);
    }
}

SKEL_WIDE void forwardFloat(Eigen::Index inputs, Eigen::Index outputs, const float* weights,
                            const float* biases, const float* input, float* output) {
  forward(inputs, outputs, weights, biases, input, output);
}

SKEL_WIDE void forwardDouble(Eigen::Index inputs, Eigen::Index outputs, const double* weights,
                             const double* biases, const double* input, double* output) {
  forward(inputs, outputs, weights, biases, input, output);
}

}  // namespace

void forwardBlock(const Eigen::MatrixXf& weights, const Eigen::VectorXf& biases, const Block<float>& inputs,
                  Block<float>& outputs) {
  SKEL_CHECK(inputs.cols() >= weights.cols() && outputs.cols() >= weights.rows());
  forwardFloat(weights.cols(), weights.rows(), weights.data(), biases.data(), inputs.data(), outputs.data());
}

void forwardBlock(const Eigen::MatrixXd& weights, const Eigen::VectorXd& biases, const Block<double>& inputs,
                  Block<double>& outputs) {
  SKEL_CHECK(inputs.cols() >= weights.cols() && outputs.cols() >= weights.rows());
  forwardDouble(weights.cols(), weights.rows(), weights.data(), biases.data(), inputs.data(), outputs.data());
}

}  // namespace skel
