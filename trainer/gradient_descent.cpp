#include <numeric>

#include "trainer/online_pass.h"
#include "trainer/optimizer.h"

namespace skel {
namespace {

// The gradient is that of the mean loss: the more samples a step sees, the longer it may be.
float learningRate(const OptimizerOptions& options, Eigen::Index samples) {
  if (options.learning_rate > 0) return static_cast<float>(options.learning_rate);
  if (options.batch == 1) return 0.5f;
  return options.batch == 0 || options.batch >= samples ? 8.f : 4.f;
}

// Without Rng::below(), whose divisions would take a tenth of an online pass; the bias is less than 1e-5.
void shuffle(std::vector<Eigen::Index>& order, Rng& rng) {
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[std::uint64_t{rng.next()} * i >> 32]);
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
        batch_(static_cast<std::size_t>(options.batch)),
        rng_(options.seed, 1),
        order_(static_cast<std::size_t>(data.samples.count())),
        blocks_({data.samples.inputs.topRows(options.batch), data.samples.targets.topRows(options.batch),
                 data.samples.weights.head(options.batch)}) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  }

  double pass(Network<float>& network) override {
    shuffle(order_, rng_);
    double loss = 0, weight = 0;
    for (std::size_t first = 0; first < order_.size(); first += batch_) {
      fill(first, std::min(order_.size() - first, batch_));
      loss += step(network, blocks_) * blocks_.total_weight;
      weight += blocks_.total_weight;
    }
    return loss / weight;
  }

 private:
  // Puts `count` samples from order_[first] on into blocks_; whatever room is left weighs nothing.
  void fill(std::size_t first, std::size_t count) {
    const Samples& all = data_.samples;
    blocks_.total_weight = 0;
    for (std::size_t i = 0; i < batch_; ++i) {
      const std::size_t block = i / kBlockSize;
      const auto row = static_cast<Eigen::Index>(i % kBlockSize);
      if (i >= count) {
        blocks_.weights[block](row) = 0;
        continue;
      }
      const Eigen::Index from = order_[first + i];
      for (Eigen::Index k = 0; k < all.inputs.cols(); ++k)
        blocks_.inputs[block](row, k) = all.inputs(from, k);
      for (Eigen::Index k = 0; k < all.targets.cols(); ++k)
        blocks_.targets[block](row, k) = all.targets(from, k);
      blocks_.weights[block](row) = all.weights[from];
      blocks_.total_weight += all.weights[from];
    }
  }

  std::size_t batch_;
  Rng rng_;
  std::vector<Eigen::Index> order_;
  SampleBlocks<float> blocks_;
};

class Online : public Optimizer {
 public:
  Online(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : pass_(sizes, data.samples,
              {learningRate(options, data.samples.count()), static_cast<float>(options.momentum),
               static_cast<float>(options.weight_decay)}),
        rng_(options.seed, 1),
        total_weight_(data.blocks.total_weight),
        order_(static_cast<std::size_t>(data.samples.count())) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  }

  double pass(Network<float>& network) override {
    shuffle(order_, rng_);
    const double loss = pass_.run(network, order_);
    limitParameters(network.parameters);
    return loss / total_weight_;
  }

 private:
  OnlinePass pass_;
  Rng rng_;
  double total_weight_;
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
