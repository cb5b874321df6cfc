// Derivatives of a convolutional net.
#pragma once

#include <vector>

#include "libskel/convnet/conv_net.h"

namespace skel {

// Weights as the pass backwards wants them: of each convolution, outputs and inputs swapped, taps turned
// round. To be made anew after each change of the parameters.
std::vector<float> transposedWeights(const ConvNet& net);

struct ConvNetGradient {
  std::vector<std::vector<float>> maps;  // of the maps of one pass; as ConvNetMaps
  std::vector<float> parameters;         // summed over passes
  explicit ConvNetGradient(const ConvNet& net);
};

// `gradient.maps.back()` holds the loss's derivative by the last map and the other maps' hold zeros. Adds
// the derivative by the parameters to gradient.parameters. The input's own derivative is not computed.
void backward(const ConvNet& net, InstructionSet set, const std::vector<float>& transposed,
              const ConvNetMaps& maps, ConvNetGradient& gradient);

}  // namespace skel
