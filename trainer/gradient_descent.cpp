#include <numeric>

#include "trainer/online_step.h"
#include "trainer/optimizer.h"

namespace skel {
namespace {

// The gradient is that of the mean loss: the more samples a step sees, the longer it may be.
float learningRate(const OptimizerOptions& options, Eigen::Index samples) {
  if (options.learning_rate > 0) return static_cast<float>(options.learning_rate);
  if (options.batch == 1) return 0.5f;
  return options.batch == 0 || options.batch >= samples ? 8.f : 2.f;
}

void shuffle(std::vector<Eigen::Index>& order, Rng& rng) {
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
}

class FullBatch : public Optimizer {
 public:
  FullBatch(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : data_(data),
        backprop_(sizes),
        decay_(decayOf(sizes, options.weight_decay)),
        learning_rate_(learningRate(options, data.samples.count())),
        momentum_(static_cast<float>(options.momentum)) {
    gradient_.setZero(decay_.size());
    move_.setZero(decay_.size());
  }

  double pass(Network<float>& network) override { return step(network, data_.blocks); }

 protected:
  double step(Network<float>& network, const SampleBlocks<float>& blocks) {
    const double loss = backprop_.lossAndGradient(network, blocks, gradient_);
    gradient_ += 2 * decay_.cwiseProduct(network.parameters);
    move_ = momentum_ * move_ - learning_rate_ * gradient_;
    network.parameters += move_;
    limitParameters(network.parameters);
    return loss;
  }

  const TrainingData& data_;

 private:
  Backprop<float> backprop_;
  Eigen::VectorXf decay_, gradient_, move_;
  float learning_rate_, momentum_;
};

class MiniBatch : public FullBatch {
 public:
  MiniBatch(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : FullBatch(data, sizes, options),
        batch_(options.batch),
        rng_(options.seed, 1),
        order_(static_cast<std::size_t>(data.samples.count())) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  }

  double pass(Network<float>& network) override {
    shuffle(order_, rng_);
    double loss = 0, weight = 0;
    for (std::size_t first = 0; first < order_.size(); first += static_cast<std::size_t>(batch_)) {
      const auto count = std::min(order_.size() - first, static_cast<std::size_t>(batch_));
      const std::vector<Eigen::Index> rows(order_.begin() + static_cast<std::ptrdiff_t>(first),
                                           order_.begin() + static_cast<std::ptrdiff_t>(first + count));
      const Samples& all = data_.samples;
      const SampleBlocks<float> blocks(
          {all.inputs(rows, Eigen::all), all.targets(rows, Eigen::all), all.weights(rows)});
      loss += step(network, blocks) * blocks.total_weight;
      weight += blocks.total_weight;
    }
    return loss / weight;
  }

 private:
  int batch_;
  Rng rng_;
  std::vector<Eigen::Index> order_;
};

class Online : public Optimizer {
 public:
  Online(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : step_(sizes, learningRate(options, data.samples.count()), static_cast<float>(options.momentum),
              decayOf(sizes, options.weight_decay)),
        rng_(options.seed, 1),
        total_weight_(data.blocks.total_weight),
        inputs_(data.samples.inputs.transpose()),
        targets_(data.samples.targets.transpose()),
        weights_(data.samples.weights),
        order_(static_cast<std::size_t>(data.samples.count())) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  }

  double pass(Network<float>& network) override {
    shuffle(order_, rng_);
    double loss = 0;
    for (const Eigen::Index s : order_)
      loss += static_cast<double>(
          step_.step(network, inputs_.col(s).data(), targets_.col(s).data(), weights_[s]));
    limitParameters(network.parameters);
    return loss / total_weight_;
  }

 private:
  OnlineStep step_;
  Rng rng_;
  double total_weight_;
  Eigen::MatrixXf inputs_, targets_;  // a sample a column
  Eigen::VectorXf weights_;
  std::vector<Eigen::Index> order_;
};

}  // namespace

std::unique_ptr<Optimizer> makeGradientDescent(const TrainingData& data, const std::vector<int>& sizes,
                                               const OptimizerOptions& options) {
  if (options.batch == 1) return std::make_unique<Online>(data, sizes, options);
  if (options.batch == 0 || options.batch >= data.samples.count())
    return std::make_unique<FullBatch>(data, sizes, options);
  return std::make_unique<MiniBatch>(data, sizes, options);
}

}  // namespace skel
