#include "libskel/classifier/block.h"

#include "libskel/classifier/block_kernel.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

SKEL_WIDE void forwardWide(int inputs, int outputs, const float* weights, const float* biases,
                           const float* input, float* output) {
  forwardKernel(inputs, outputs, weights, biases, input, output);
}

}  // namespace

void forwardBlock(const Eigen::MatrixXf& weights, const Eigen::VectorXf& biases, const Block<float>& inputs,
                  Block<float>& outputs) {
  SKEL_CHECK(inputs.cols() >= weights.cols() && outputs.cols() >= weights.rows());
  forwardWide(static_cast<int>(weights.cols()), static_cast<int>(weights.rows()), weights.data(),
              biases.data(), inputs.data(), outputs.data());
}

}  // namespace skel
