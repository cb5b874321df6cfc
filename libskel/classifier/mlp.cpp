#include "libskel/classifier/mlp.h"

#include <algorithm>

#include "libskel/classifier/block.h"
#include "libskel/core/check.h"

namespace skel {

std::vector<int> Mlp::sizes() const {
  std::vector<int> sizes;
  for (const MlpLayer& layer : layers) {
    if (sizes.empty()) sizes.push_back(static_cast<int>(layer.weights.cols()));
    sizes.push_back(static_cast<int>(layer.weights.rows()));
  }
  return sizes;
}

Eigen::MatrixXf evaluate(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXf>& samples) {
  SKEL_CHECK(!mlp.layers.empty());
  const std::vector<int> sizes = mlp.sizes();
  SKEL_CHECK_EQ(samples.cols(), sizes.front());
  const int widest = *std::max_element(sizes.begin(), sizes.end());
  Block<float> inputs = Block<float>::Zero(kBlockSize, widest), outputs(kBlockSize, widest);
  Eigen::MatrixXf result(samples.rows(), sizes.back());
  for (Eigen::Index first = 0; first < samples.rows(); first += kBlockSize) {
    const Eigen::Index count = std::min<Eigen::Index>(kBlockSize, samples.rows() - first);
    inputs.topLeftCorner(count, samples.cols()) = samples.middleRows(first, count).array();
    for (const MlpLayer& layer : mlp.layers) {
      forwardBlock(layer.weights, layer.biases, inputs, outputs);
      inputs.swap(outputs);
    }
    result.middleRows(first, count) = inputs.topLeftCorner(count, result.cols()).matrix();
  }
  return result;
}

ClassProbabilities classify(const Mlp& mlp, const Features& features) {
  const Eigen::MatrixXf bits = evaluate(mlp, features);
  SKEL_CHECK_EQ(bits.cols(), 2);
  ClassProbabilities probabilities = ClassProbabilities::Ones(bits.rows(), kJointClassCount);
  for (int c = 0; c < kJointClassCount; ++c)
    for (int b = 0; b < 2; ++b) {
      const auto bit = bits.col(b).array();
      if (kJointClassCodes[c][b] == 1)
        probabilities.col(c).array() *= bit;
      else
        probabilities.col(c).array() *= 1 - bit;
    }
  return probabilities;
}

}  // namespace skel
