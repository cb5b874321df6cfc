#include "trainer/online_step.h"

#include <algorithm>

#include "libskel/classifier/sigmoid.h"

namespace skel {

OnlineStep::OnlineStep(const std::vector<int>& sizes, float learning_rate, float momentum,
                       Eigen::VectorXf decay)
    : learning_rate_(learning_rate),
      momentum_(momentum),
      decay_(std::move(decay)),
      decays_(!decay_.isZero(0)) {
  move_.setZero(decay_.size());
  for (const int size : sizes) activations_.emplace_back(Eigen::VectorXf::Zero(size));
  const int widest = *std::max_element(sizes.begin(), sizes.end());
  delta_.setZero(widest);
  delta_below_.setZero(widest);
}

float OnlineStep::step(Network<float>& network, const float* input, const float* target, float weight) {
  const int count = network.layerCount();
  std::copy_n(input, activations_[0].size(), activations_[0].data());
  float* parameters = network.parameters.data();
  for (int l = 0, offset = 0; l < count; ++l) {
    const int inputs = network.inputs(l), outputs = network.outputs(l);
    const float* weights = parameters + offset;
    const float* biases = weights + inputs * outputs;
    const float* from = activations_[static_cast<std::size_t>(l)].data();
    float* to = activations_[static_cast<std::size_t>(l) + 1].data();
    for (int j = 0; j < outputs; ++j) to[j] = biases[j];
    for (int i = 0; i < inputs; ++i)
      for (int j = 0; j < outputs; ++j) to[j] += weights[i * outputs + j] * from[i];
    for (int j = 0; j < outputs; ++j) to[j] = sigmoid(to[j]);
    offset += (inputs + 1) * outputs;
  }
  const Eigen::VectorXf& output = activations_.back();
  const float scale = weight / static_cast<float>(output.size());
  float loss = 0;
  for (Eigen::Index j = 0; j < output.size(); ++j) {
    const float difference = output[j] - target[j];
    loss += scale * difference * difference;
    delta_[j] = std::clamp(2 * scale * difference * (output[j] * (1 - output[j])), -1.f, 1.f);
  }
  for (int l = count - 1, offset = static_cast<int>(move_.size()); l >= 0; --l) {
    const int inputs = network.inputs(l), outputs = network.outputs(l);
    offset -= (inputs + 1) * outputs;
    float* weights = parameters + offset;
    float* moves = move_.data() + offset;
    const float* from = activations_[static_cast<std::size_t>(l)].data();
    if (l > 0)
      for (int i = 0; i < inputs; ++i) {
        float sum = 0;
        for (int j = 0; j < outputs; ++j) sum += weights[i * outputs + j] * delta_[j];
        delta_below_[i] = std::clamp(sum * (from[i] * (1 - from[i])), -1.f, 1.f);
      }
    for (int j = 0; j < outputs; ++j) delta_[j] *= -learning_rate_;
    for (int i = 0; i <= inputs; ++i) {
      const float activation = i < inputs ? from[i] : 1;
      for (int j = 0; j < outputs; ++j) {
        float& move = moves[i * outputs + j];
        move = momentum_ * move + delta_[j] * activation;
        weights[i * outputs + j] += move;
      }
    }
    delta_.swap(delta_below_);
  }
  if (decays_) network.parameters -= 2 * learning_rate_ * decay_.cwiseProduct(network.parameters);
  return loss;
}

}  // namespace skel
