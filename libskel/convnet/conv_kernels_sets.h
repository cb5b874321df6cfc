// The builds of the kernels, for conv_kernels.cpp to choose from.
#pragma once

namespace skel {

struct ConvShape;
enum class InstructionSet;

inline constexpr int kWeightPanel = 16;  // see weightIndex()

// Pointers are to the map's first pixel.
struct ConvTask {
  const float* in;
  const long* tap_offsets;  // floats
  int taps, in_channels, out_channels;
  const float *weights, *bias, *skip;  // bias and skip may be null
  bool relu;
  float* out;
  long pixels;
};
struct GradientTask {
  const float* in;
  const long* tap_offsets;
  int taps, in_channels, out_channels;
  const float* out_gradient;
  float* weight_gradient;
  long pixels;
};
// Of a map of 2×2 tiles, whose 16 products lie in a plane each.
struct WinogradTask {
  const float* in;
  int height, width, tiles_across, in_channels, out_channels;
  const float *bias, *skip;  // may be null
  bool relu;
  float *tiles, *products;
  float* out;
};
struct ConvKernels {
  void (*convolve)(const ConvTask& task);
  void (*gradient)(const GradientTask& task);
  // Of `rows` rows of tiles from `first_row` on.
  void (*transform)(const WinogradTask& task, int first_row, int rows);
  void (*untransform)(const WinogradTask& task, int first_row, int rows);
};

extern const ConvKernels kBaselineKernels;
#ifdef SKEL_X86_KERNELS
extern const ConvKernels kAvx2Kernels;
extern const ConvKernels kAvx512Kernels;
#endif
const ConvKernels& kernelsOf(InstructionSet set);

void checkShape(InstructionSet set, const ConvShape& shape);
// Sets what lies between and around the pixels of a map of `shape`'s outputs to zero.
void clearPadding(const ConvShape& shape, float* out);

}  // namespace skel
