#include "trainer/optimizer.h"

namespace skel {
namespace {

constexpr float kFirstStep = 0.1f, kLeastStep = 1e-6f, kLargestStep = 1, kGrow = 1.2f, kShrink = 0.5f;

class Rprop : public Optimizer {
 public:
  Rprop(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : data_(data), backprop_(sizes), decay_(decayOf(sizes, options.weight_decay)) {
    gradient_.setZero(decay_.size());
    last_gradient_.setZero(decay_.size());
    steps_.setConstant(decay_.size(), kFirstStep);
  }

  double pass(Network<float>& network) override {
    const double loss = backprop_.lossAndGradient(network, data_.blocks, gradient_);
    gradient_ += 2 * decay_.cwiseProduct(network.parameters);
    for (Eigen::Index i = 0; i < gradient_.size(); ++i) {
      const float agreement = gradient_[i] * last_gradient_[i];
      if (agreement > 0) {
        steps_[i] = std::min(steps_[i] * kGrow, kLargestStep);
      } else if (agreement < 0) {
        steps_[i] = std::max(steps_[i] * kShrink, kLeastStep);
        gradient_[i] = 0;
      }
      if (gradient_[i] > 0) network.parameters[i] -= steps_[i];
      if (gradient_[i] < 0) network.parameters[i] += steps_[i];
    }
    limitParameters(network.parameters);
    last_gradient_.swap(gradient_);
    return loss;
  }

 private:
  const TrainingData& data_;
  Backprop<float> backprop_;
  Eigen::VectorXf decay_, gradient_, last_gradient_, steps_;
};

}  // namespace

std::unique_ptr<Optimizer> makeRprop(const TrainingData& data, const std::vector<int>& sizes,
                                     const OptimizerOptions& options) {
  return std::make_unique<Rprop>(data, sizes, options);
}

}  // namespace skel
