// The two inner loops of the joint net, built for several instruction sets and chosen at start.
//
// Feature maps lie padded in memory, so that a 3×3 convolution is nine matrix products over shifted views of
// one array and needs no copies. A map of H×W pixels and C channels is an array of
// paddedPixels(H, W) pixels of C floats; pixel (y, x) has the index (y + 1)·(W + 1) + x + 1, and all others
// are zero. One column of zeros is the right border of its row and the left border of the next.
#pragma once

#include <string_view>
#include <vector>

namespace skel {

inline constexpr int paddedStride(int width) { return width + 1; }
inline constexpr int paddedPixels(int height, int width) { return (height + 2) * (width + 1) + 1; }
inline constexpr int paddedIndex(int width, int y, int x) { return (y + 1) * (width + 1) + x + 1; }

struct ConvShape {
  int height, width;
  int in_channels;   // a multiple of 8
  int out_channels;  // a multiple of 16
  int kernel;        // 1 or 3
  int taps() const { return kernel * kernel; }
  int weights() const { return taps() * in_channels * out_channels; }
};

// Where a weight lies. Sixteen output channels at a time, so that the loop over taps and input channels reads
// on and on: panels of out_channels × taps × in_channels × 16.
int weightIndex(const ConvShape& shape, int tap, int in, int out);

enum class InstructionSet {
  kBaseline,  // four floats at a time, no fused multiply-add: every machine
  kAvx2,      // AVX2 and FMA
  kAvx512,    // AVX-512 F
};
inline constexpr InstructionSet kInstructionSets[] = {InstructionSet::kBaseline, InstructionSet::kAvx2,
                                                      InstructionSet::kAvx512};

std::string_view instructionSetName(InstructionSet set);
// Whether this machine and this build have it.
bool hasInstructionSet(InstructionSet set);
InstructionSet bestInstructionSet();

// out(p) = bias + sum over taps t and input channels of in(p + offset(t)) · weights + skip(p), then the
// maximum of that and 0 if `relu`, for every pixel p of the map. The padding of `out` is set to zero.
// weights: as weightIndex() says. bias and skip (a map like `out`, or `out` itself) may be null.
void convolve(InstructionSet set, const ConvShape& shape, const float* in, const float* weights,
              const float* bias, const float* skip, bool relu, float* out);

// weight_gradient += the derivative of the sum of out · out_gradient by the weights, for out as above. The
// padding of out_gradient must be zero.
void convolveWeightGradient(InstructionSet set, const ConvShape& shape, const float* in,
                            const float* out_gradient, float* weight_gradient);

}  // namespace skel
