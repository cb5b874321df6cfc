#include "trainer/training.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "libskel/core/check.h"
#include "libskel/core/parallel.h"

namespace skel {
namespace {

// Moves `count` random pictures to the end.
void shuffleTail(std::vector<Characters>& pictures, std::size_t count, Rng& rng) {
  for (std::size_t i = pictures.size(); i > pictures.size() - count; --i)
    std::swap(pictures[i - 1], pictures[rng.below(static_cast<std::uint32_t>(i))]);
}

// Inputs to mean 0 and deviation 1.
class Scaling {
 public:
  explicit Scaling(const Eigen::MatrixXf& inputs) : mean_(inputs.cols()), deviation_(inputs.cols()) {
    for (Eigen::Index k = 0; k < inputs.cols(); ++k) {
      // One after the other: how Eigen splits a sum may depend on the machine.
      double sum = 0, squares = 0;
      for (const float value : inputs.col(k)) sum += value, squares += double{value} * value;
      const double mean = sum / static_cast<double>(inputs.rows());
      const double variance = squares / static_cast<double>(inputs.rows()) - mean * mean;
      mean_[k] = static_cast<float>(mean);
      deviation_[k] = variance > 1e-6 ? static_cast<float>(std::sqrt(variance)) : 1.f;
    }
  }
  void apply(Eigen::MatrixXf& inputs) const {
    for (Eigen::Index k = 0; k < inputs.cols(); ++k)
      for (float& value : inputs.col(k)) value = (value - mean_[k]) / deviation_[k];
  }
  // From a net of scaled inputs to the same net of the inputs themselves.
  void moveInto(Mlp& mlp) const {
    MlpLayer& first = mlp.layers.front();
    for (Eigen::Index k = 0; k < first.weights.cols(); ++k)
      for (Eigen::Index j = 0; j < first.weights.rows(); ++j) {
        first.weights(j, k) /= deviation_[k];
        first.biases[j] -= first.weights(j, k) * mean_[k];
      }
  }

 private:
  Eigen::VectorXf mean_, deviation_;
};

}  // namespace

Training trainOnce(const TrainingData& data, const TrainingData* held_out, const TrainingOptions& options,
                   int start, const TrainingProgress& progress) {
  Network<float> network(options.layers);
  Rng rng(static_cast<std::uint64_t>(options.seed), static_cast<std::uint64_t>(start));
  randomize(network, rng);
  OptimizerOptions optimizer_options = options.optimizer;
  optimizer_options.seed =
      (static_cast<std::uint64_t>(options.seed) << 16) + static_cast<std::uint64_t>(start);
  const auto optimizer = makeOptimizer(options.method, data, options.layers, optimizer_options);
  Backprop<float> backprop(options.layers);
  Training training;
  training.loss = std::numeric_limits<double>::infinity();
  Network<float> best = network;
  for (int epoch = 0; epoch < options.epochs; ++epoch) {
    const Eigen::VectorXf before = network.parameters;
    double loss = held_out ? backprop.loss(network, held_out->blocks) : 0;
    if (held_out) training.validation_curve.push_back(static_cast<float>(loss));
    const double training_loss = optimizer->pass(network);
    training.training_curve.push_back(static_cast<float>(training_loss));
    if (!held_out) loss = training_loss;
    if (progress) progress(loss);
    if (loss < training.loss) {
      training.loss = loss;
      training.epochs = epoch;
      best.parameters = before;
    }
    if (held_out && epoch - training.epochs >= options.patience) break;
  }
  training.mlp = toMlp(best);
  return training;
}

Training train(const Characters& characters, const Characters& generated, const TrainingOptions& options,
               const TrainingProgress& progress) {
  SKEL_CHECK(!characters.empty());
  std::vector<Characters> order = byPicture(characters);
  std::size_t held_out = 0;
  if (options.validation > 0 && order.size() > 1)
    held_out = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::lround(options.validation * static_cast<double>(order.size()))), 1,
        order.size() - 1);
  Rng rng(static_cast<std::uint64_t>(options.seed), ~std::uint64_t{0} >> 1);
  shuffleTail(order, held_out, rng);
  const auto border = order.end() - static_cast<std::ptrdiff_t>(held_out);
  SampleOptions as_they_are = options.samples;
  as_they_are.mirror = false;
  as_they_are.warps = 0;
  Samples samples = joined(samplesOf(joined(std::vector<Characters>(order.begin(), border)), options.samples),
                           samplesOf(generated, as_they_are));
  const Scaling scaling(samples.inputs);
  scaling.apply(samples.inputs);
  const TrainingData data(std::move(samples));
  std::unique_ptr<TrainingData> validation;
  if (held_out > 0) {
    Samples held = samplesOf(joined(std::vector<Characters>(border, order.end())), options.samples);
    scaling.apply(held.inputs);
    validation = std::make_unique<TrainingData>(std::move(held));
  }

  std::vector<Training> trainings(static_cast<std::size_t>(options.restarts));
  parallelFor(trainings.size(), options.threads, [&](std::size_t i) {
    trainings[i] = trainOnce(data, validation.get(), options, static_cast<int>(i), progress);
  });
  Training best = *std::min_element(trainings.begin(), trainings.end(),
                                    [](const Training& a, const Training& b) { return a.loss < b.loss; });
  scaling.moveInto(best.mlp);
  return best;
}

}  // namespace skel
