// Error back-propagation (Rumelhart, Hinton, Williams 1986) through a net of sigmoids.
#pragma once

#include <vector>

#include "trainer/network.h"
#include "trainer/samples.h"

namespace skel {

// The mean squared error per output, sum of w (y - t)² / (outputs · sum of w), and its gradient. Samples are
// taken block after block and sums formed in a fixed order: the same bits on every machine.
template <class Scalar>
class Backprop {
 public:
  using Vector = typename Network<Scalar>::Vector;

  explicit Backprop(const std::vector<int>& sizes);

  // Over blocks [first, last) of `samples`. `gradient` has the layout of Network::parameters. 0 and a
  // gradient of 0 where the blocks have no weight.
  double lossAndGradient(const Network<Scalar>& network, const SampleBlocks<Scalar>& samples,
                         std::size_t first, std::size_t last, Vector& gradient);
  // Over all blocks.
  double lossAndGradient(const Network<Scalar>& network, const SampleBlocks<Scalar>& samples,
                         Vector& gradient) {
    return lossAndGradient(network, samples, 0, samples.inputs.size(), gradient);
  }
  double loss(const Network<Scalar>& network, const SampleBlocks<Scalar>& samples);

 private:
  std::vector<Block<Scalar>> activations_;  // of each layer but the inputs
  std::vector<Block<Scalar>> deltas_;       // error of each layer's sums
  // A column for each parameter, a row for each lane; one more column for the error.
  Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic> sums_;
};
extern template class Backprop<float>;
extern template class Backprop<double>;

}  // namespace skel
