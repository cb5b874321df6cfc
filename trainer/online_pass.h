// Gradient descent with a step after every sample.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trainer/network.h"
#include "trainer/samples.h"

namespace skel {

struct OnlineOptions {
  float learning_rate = 0.5f, momentum = 0;
  float weight_decay = 0;
};

// The loss of a sample is w · sum of (y - t)² / outputs. A step is
// move = momentum · move - learning_rate · gradient; parameters += move; then weights lose the share
// 2 · learning_rate · weight_decay. Errors beyond ±1 move parameters as ±1 would, so that no learning rate
// can drive a parameter out of a float's range.
class OnlinePass {
 public:
  OnlinePass(const std::vector<int>& sizes, const Samples& samples, const OnlineOptions& options);

  // A step for each sample, in this order. Returns the sum of the samples' losses, each before its step.
  double run(Network<float>& network, const std::vector<Eigen::Index>& order);

  // The units of a layer are filled up to whole vectors: those have no weights and never get any.
  struct Layer {
    int inputs, outputs, padded_outputs;
    // A column for each input and one for the biases, padded_outputs long.
    std::vector<float> parameters, moves;
    std::vector<float> activations, deltas;  // padded_outputs
  };
  struct Sample {
    const float *input, *target;
    float weight;
  };

 private:
  void copyFrom(const Network<float>& network);
  void copyTo(Network<float>& network) const;

  OnlineOptions options_;
  std::vector<Layer> layers_;
  Eigen::MatrixXf inputs_, targets_;  // a sample a column; targets filled up with 0.5
  Eigen::VectorXf weights_;
  std::vector<Sample> samples_;  // of the pass under way
};

}  // namespace skel
