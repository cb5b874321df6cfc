#include "libskel/convnet/conv_kernels.h"

#include <algorithm>
#include <array>

#include "libskel/convnet/conv_kernels_sets.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

std::array<long, 9> tapOffsets(const ConvShape& shape) {
  std::array<long, 9> offsets{};
  if (shape.kernel == 1) return offsets;
  for (int t = 0; t < 9; ++t) {
    offsets[t] = (static_cast<long>(t / 3 - 1) * paddedStride(shape.width) + t % 3 - 1) * shape.in_channels;
  }
  return offsets;
}

// From the first pixel to the last, with the zeros between the rows.
long runLength(const ConvShape& shape) {
  return static_cast<long>(shape.height) * paddedStride(shape.width) - 1;
}

}  // namespace

const ConvKernels& kernelsOf(InstructionSet set) {
#ifdef SKEL_X86_KERNELS
  if (set == InstructionSet::kAvx512) return kAvx512Kernels;
  if (set == InstructionSet::kAvx2) return kAvx2Kernels;
#else
  (void)set;
#endif
  return kBaselineKernels;
}

void checkShape(InstructionSet set, const ConvShape& shape) {
  SKEL_CHECK(hasInstructionSet(set));
  SKEL_CHECK(shape.kernel == 1 || shape.kernel == 3);
  SKEL_CHECK(shape.height > 0 && shape.width > 0);
  SKEL_CHECK(shape.in_channels > 0 && shape.in_channels % 8 == 0);
  SKEL_CHECK(shape.out_channels > 0 && shape.out_channels % kWeightPanel == 0);
}

void clearPadding(const ConvShape& shape, float* out) {
  const long channels = shape.out_channels;
  std::fill_n(out, paddedIndex(shape.width, 0, 0) * channels, 0.f);
  for (int y = 0; y + 1 < shape.height; ++y) {
    std::fill_n(out + paddedIndex(shape.width, y, shape.width) * channels, channels, 0.f);
  }
  const long last = paddedIndex(shape.width, shape.height - 1, shape.width);
  std::fill(out + last * channels, out + paddedPixels(shape.height, shape.width) * channels, 0.f);
}

int weightIndex(const ConvShape& shape, int tap, int in, int out) {
  return ((out / kWeightPanel * shape.taps() + tap) * shape.in_channels + in) * kWeightPanel +
         out % kWeightPanel;
}

std::string_view instructionSetName(InstructionSet set) {
  switch (set) {
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
    default:
      return "baseline";
  }
}

bool hasInstructionSet(InstructionSet set) {
#ifdef SKEL_X86_KERNELS
  static const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  static const bool avx512 = avx2 && __builtin_cpu_supports("avx512f");
  if (set == InstructionSet::kAvx2) return avx2;
  if (set == InstructionSet::kAvx512) return avx512;
#endif
  return set == InstructionSet::kBaseline;
}

InstructionSet bestInstructionSet() {
  for (const InstructionSet set : {InstructionSet::kAvx512, InstructionSet::kAvx2}) {
    if (hasInstructionSet(set)) return set;
  }
  return InstructionSet::kBaseline;
}

void convolve(InstructionSet set, const ConvShape& shape, const float* in, const float* weights,
              const float* bias, const float* skip, bool relu, float* out) {
  checkShape(set, shape);
  const auto offsets = tapOffsets(shape);
  const long first = paddedIndex(shape.width, 0, 0), channels = shape.out_channels;
  kernelsOf(set).convolve({in + first * shape.in_channels, offsets.data(), shape.taps(), shape.in_channels,
                           shape.out_channels, weights, bias, skip ? skip + first * channels : nullptr, relu,
                           out + first * channels, runLength(shape)});
  clearPadding(shape, out);  // the run went over it
}

void convolveWeightGradient(InstructionSet set, const ConvShape& shape, const float* in,
                            const float* out_gradient, float* weight_gradient) {
  checkShape(set, shape);
  const auto offsets = tapOffsets(shape);
  const long first = paddedIndex(shape.width, 0, 0);
  kernelsOf(set).gradient({in + first * shape.in_channels, offsets.data(), shape.taps(), shape.in_channels,
                           shape.out_channels, out_gradient + first * shape.out_channels, weight_gradient,
                           runLength(shape)});
}

}  // namespace skel
