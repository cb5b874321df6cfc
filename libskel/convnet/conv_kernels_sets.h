// The builds of the kernels, for conv_kernels.cpp to choose from.
#pragma once

namespace skel {

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
struct ConvKernels {
  void (*convolve)(const ConvTask& task);
  void (*gradient)(const GradientTask& task);
};

extern const ConvKernels kBaselineKernels;
#ifdef SKEL_X86_KERNELS
extern const ConvKernels kAvx2Kernels;
extern const ConvKernels kAvx512Kernels;
#endif

}  // namespace skel
