// Logistic regression with a few hidden units, by Adam on shuffled batches.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libskel/core/logistic_net.h"

namespace skel {

struct LogisticFitOptions {
  int hidden = 6;
  int steps = 2000;
  int batch = 256;
  double rate = 1e-2;   // falls to 0 along a cosine
  double decay = 1e-3;  // of squared weights (the biases apart), added to the mean loss
  std::uint64_t seed = 1;
};

// `inputs`: a row a case; `came_true`: 0 or 1; `weights`: how much a case counts, >= 0. The loss is the cross
// entropy. The same bytes for the same data and options.
LogisticNet fitLogisticNet(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& came_true,
                           const Eigen::VectorXd& weights, const LogisticFitOptions& options = {});

}  // namespace skel
