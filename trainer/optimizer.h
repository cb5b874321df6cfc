// How a net is made better, one pass over the samples after the other.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trainer/backprop.h"
#include "trainer/network.h"
#include "trainer/samples.h"

namespace skel {

struct TrainingData {
  explicit TrainingData(Samples rows) : samples(std::move(rows)), blocks(samples) {}

  Samples samples;
  SampleBlocks<float> blocks;
};

struct OptimizerOptions {
  double learning_rate = 0;  // gradient descent; 0: what suits the batch
  double momentum = 0.5;     // gradient descent, [0, 1)
  int batch = 1;             // gradient descent: samples a step; 0: all; 1: "online"
  double weight_decay = 0;   // adds weight_decay · sum of w² to the loss; biases are free
  std::uint64_t seed = 1;    // order of the samples
};

class Optimizer {
 public:
  virtual ~Optimizer() = default;
  // One pass over all samples. Returns the loss, without the decay's part, of the parameters as they were
  // before it, or, where they change within the pass, the mean of their losses on the way. No parameter ever
  // leaves ±kMaxParameter.
  virtual double pass(Network<float>& network) = 0;
};

inline constexpr float kMaxParameter = 1e4f;

enum class TrainingMethod { kGradient, kRprop, kLbfgs };
inline constexpr std::array<const char*, 3> kTrainingMethodNames = {"gradient", "rprop", "lbfgs"};

// `data` must outlive the optimiser. An optimiser belongs to one training: it remembers earlier steps.
std::unique_ptr<Optimizer> makeOptimizer(TrainingMethod method, const TrainingData& data,
                                         const std::vector<int>& sizes, const OptimizerOptions& options);

// Gradient descent with momentum, as in Shu & Yang (2018) and Rumelhart et al. (1986).
std::unique_ptr<Optimizer> makeGradientDescent(const TrainingData& data, const std::vector<int>& sizes,
                                               const OptimizerOptions& options);
// iRprop- (Igel & Hüsken 2003): a step of its own for each parameter, which grows while the gradient keeps
// its sign. Steps are capped: without that, long trainings run into the flat ends of the sigmoids.
std::unique_ptr<Optimizer> makeRprop(const TrainingData& data, const std::vector<int>& sizes,
                                     const OptimizerOptions& options);
// L-BFGS (Nocedal 1980; Nocedal & Wright 2006, algorithms 7.4 and 3.1): curvature from the last steps, each
// step as long as the loss falls enough. A pass is one step, which may look at the samples several times.
std::unique_ptr<Optimizer> makeLbfgs(const TrainingData& data, const std::vector<int>& sizes,
                                     const OptimizerOptions& options);

// weight_decay where a parameter is a weight, 0 where it is a bias.
Eigen::VectorXf decayOf(const std::vector<int>& sizes, double weight_decay);
inline void limitParameters(Eigen::VectorXf& parameters) {
  parameters = parameters.cwiseMax(-kMaxParameter).cwiseMin(kMaxParameter);
}

}  // namespace skel
