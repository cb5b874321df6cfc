#include "trainer/network.h"

namespace skel {

void randomize(Network<float>& network, Rng& rng) {
  constexpr double kRange = 1.5;
  for (float& parameter : network.parameters) parameter = static_cast<float>(rng.uniform(-kRange, kRange));
}

Mlp toMlp(Network<float> network) {
  Mlp mlp;
  for (int l = 0; l < network.layerCount(); ++l)
    mlp.layers.push_back({network.weights(l), network.biases(l)});
  return mlp;
}

}  // namespace skel
