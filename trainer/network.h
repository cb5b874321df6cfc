// A net in training: all its weights and biases in one vector, so that optimisers need not know the layers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/classifier/mlp.h"
#include "libskel/core/rng.h"

namespace skel {

template <class Scalar>
struct Network {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  // Layer after layer: weights (outputs × inputs, column by column), then biases.
  std::vector<int> sizes;  // units of each layer, the inputs first
  Vector parameters;

  explicit Network(std::vector<int> layer_sizes) : sizes(std::move(layer_sizes)) {
    parameters.setZero(offset(layerCount()));
  }
  int layerCount() const { return static_cast<int>(sizes.size()) - 1; }
  int inputs(int layer) const { return sizes[static_cast<std::size_t>(layer)]; }
  int outputs(int layer) const { return sizes[static_cast<std::size_t>(layer) + 1]; }
  // Of a layer's first weight in `parameters`.
  int offset(int layer) const {
    int count = 0;
    for (int l = 0; l < layer; ++l) count += (inputs(l) + 1) * outputs(l);
    return count;
  }
  Eigen::Map<Matrix> weights(int layer) {
    return {parameters.data() + offset(layer), outputs(layer), inputs(layer)};
  }
  Eigen::Map<Vector> biases(int layer) {
    return {parameters.data() + offset(layer) + inputs(layer) * outputs(layer), outputs(layer)};
  }
};

// Uniform numbers, wide enough for the sigmoids of a layer to look in different directions, narrow enough for
// none of them to be flat.
void randomize(Network<float>& network, Rng& rng);

Mlp toMlp(Network<float> network);

}  // namespace skel
