// 3×3 convolutions with 16 instead of 36 multiplications for four outputs: A. Lavin, S. Gray, "Fast
// algorithms for convolutional neural networks" (2016), F(2×2, 3×3).
#pragma once

#include "libskel/convnet/conv_kernels.h"

namespace skel {

// GgGᵀ of each pair of channels, from weights as weightIndex() says: sixteen blocks that are each laid out
// as the weights of a 1×1 convolution.
inline std::size_t winogradWeightCount(const ConvShape& shape) {
  return 16 * static_cast<std::size_t>(shape.in_channels) * static_cast<std::size_t>(shape.out_channels);
}
void winogradWeights(const ConvShape& shape, const float* weights, float* transformed);

// Sixteen channels are the widest vector; the transforms go over whole ones.
bool suitsWinograd(const ConvShape& shape);

// As convolve() with a kernel of 3, but for rounding. `scratch` is resized as needed.
void convolveWinograd(InstructionSet set, const ConvShape& shape, const float* in, const float* transformed,
                      const float* bias, const float* skip, bool relu, float* out,
                      std::vector<float>& scratch);

}  // namespace skel
