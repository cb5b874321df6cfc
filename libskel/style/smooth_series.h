// A series of numbers without its noise.
//
// E. Whittaker, "On a new method of graduation" (1923); P. Eilers, "A perfect smoother" (2003).
#pragma once

#include <Eigen/Core>

namespace skel {

// The z that minimises Σ w (z − y)² + strength · Σ (z_i−1 − 2 z_i + z_i+1)², each column of y (m×n) by
// itself. `weights`: m, >= 0; where they are 0, z goes on as it bends least. `loop`: the first follows the
// last. A series without weights becomes zero.
Eigen::MatrixXd smoothSeries(const Eigen::MatrixXd& y, const Eigen::VectorXd& weights, double strength,
                             bool loop);

}  // namespace skel
