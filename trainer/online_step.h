// One step of gradient descent for one sample at a time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trainer/network.h"

namespace skel {

// The loss of a sample is w · sum of (y - t)² / outputs. A step is
// move = momentum · move - learning_rate · (gradient + 2 · decay · parameters); parameters += move.
class OnlineStep {
 public:
  OnlineStep(const std::vector<int>& sizes, float learning_rate, float momentum, Eigen::VectorXf decay);

  // The sample's loss before the step. Errors of units beyond ±1 count as that, so that no learning rate can
  // drive a parameter out of a float's range.
  float step(Network<float>& network, const float* input, const float* target, float weight);

 private:
  float learning_rate_, momentum_;
  Eigen::VectorXf decay_, move_;
  bool decays_;
  std::vector<Eigen::VectorXf> activations_;  // of each layer, the inputs first
  Eigen::VectorXf delta_, delta_below_;
};

}  // namespace skel
