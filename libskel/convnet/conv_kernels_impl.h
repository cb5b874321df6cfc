// The loops of conv_kernels.h over a vector type, to be compiled once an instruction set: the file that
// includes this one is compiled with its own machine flags and so must not instantiate anything that another
// file could share. Hence no standard headers and everything in an unnamed namespace.
//
// Before inclusion, SKEL_VECTOR names a struct with
//   kLanes; Vector; load(p); store(p, v); broadcast(x); zero(); add(a, b); subtract(a, b); maximum(a, b);
//   multiplyAdd(a, b, c) = a·b + c
// and SKEL_ROWS is the number of pixels whose sums are held in registers at a time.
#pragma once

// Without it the sums of a tile end up in memory instead of registers.
#define SKEL_UNROLL _Pragma("GCC unroll 16")

namespace skel {
namespace {

using V = SKEL_VECTOR;

// Where the weights of an output channel begin.
template <typename Task>
inline long panelOffset(const Task& task, int channel) {
  return static_cast<long>(channel / kWeightPanel) * task.taps * task.in_channels * kWeightPanel +
         channel % kWeightPanel;
}

// kRows pixels × kVectors·kLanes channels: summed over all taps and input channels in registers, so that each
// loaded weight serves kRows pixels.
template <int kRows, int kVectors>
inline void convolveTile(const ConvTask& task, long pixel, int channel) {
  const int in_channels = task.in_channels, out_channels = task.out_channels;
  const long at = pixel * out_channels + channel;
  typename V::Vector sum[kRows][kVectors];
  SKEL_UNROLL for (int v = 0; v < kVectors; ++v) {
    const typename V::Vector first = task.bias ? V::load(task.bias + channel + v * V::kLanes) : V::zero();
    SKEL_UNROLL for (int r = 0; r < kRows; ++r) sum[r][v] = first;
  }
  const float* weights[kVectors];
  SKEL_UNROLL for (int v = 0; v < kVectors; ++v) weights[v] =
      task.weights + panelOffset(task, channel + v * V::kLanes);
  for (int t = 0; t < task.taps; ++t) {
    const float* a = task.in + task.tap_offsets[t] + pixel * in_channels;
    for (int c = 0; c < in_channels; ++c) {
      typename V::Vector w[kVectors];
      SKEL_UNROLL for (int v = 0; v < kVectors; ++v) {
        w[v] = V::load(weights[v]);
        weights[v] += kWeightPanel;
      }
      SKEL_UNROLL for (int r = 0; r < kRows; ++r) {
        const typename V::Vector x = V::broadcast(a[r * in_channels + c]);
        SKEL_UNROLL for (int v = 0; v < kVectors; ++v) sum[r][v] = V::multiplyAdd(x, w[v], sum[r][v]);
      }
    }
  }
  SKEL_UNROLL for (int r = 0; r < kRows; ++r) {
    SKEL_UNROLL for (int v = 0; v < kVectors; ++v) {
      const long i = at + r * out_channels + v * V::kLanes;
      typename V::Vector y = sum[r][v];
      if (task.skip) y = V::add(y, V::load(task.skip + i));
      if (task.relu) y = V::maximum(y, V::zero());
      V::store(task.out + i, y);
    }
  }
}

template <int kRows, int kVectors>
void convolveRun(const ConvTask& task, long pixel, int channel) {
  for (; pixel + kRows <= task.pixels; pixel += kRows) convolveTile<kRows, kVectors>(task, pixel, channel);
  if constexpr (kRows > 1) {
    if (pixel < task.pixels) convolveRun<kRows / 2, kVectors>(task, pixel, channel);
  }
}

void convolvePixels(const ConvTask& task) {
  int n = 0;
  for (; n + 2 * V::kLanes <= task.out_channels; n += 2 * V::kLanes) convolveRun<SKEL_ROWS, 2>(task, 0, n);
  for (; n + V::kLanes <= task.out_channels; n += V::kLanes) convolveRun<SKEL_ROWS, 1>(task, 0, n);
}

// The weights' gradient for kRows input channels from `c` on and kVectors·kLanes output channels, summed over
// a stretch of pixels.
template <int kRows, int kVectors>
inline void gradientTile(const GradientTask& task, int tap, long pixel, long pixels, int c, int channel) {
  float* to[kVectors];
  typename V::Vector sum[kRows][kVectors];
  SKEL_UNROLL for (int v = 0; v < kVectors; ++v) {
    to[v] = task.weight_gradient + panelOffset(task, channel + v * V::kLanes) +
            (static_cast<long>(tap) * task.in_channels + c) * kWeightPanel;
    SKEL_UNROLL for (int r = 0; r < kRows; ++r) sum[r][v] = V::load(to[v] + r * kWeightPanel);
  }
  const float* x = task.in + task.tap_offsets[tap] + pixel * task.in_channels + c;
  const float* g = task.out_gradient + pixel * task.out_channels + channel;
  for (long p = 0; p < pixels; ++p, x += task.in_channels, g += task.out_channels) {
    typename V::Vector y[kVectors];
    SKEL_UNROLL for (int v = 0; v < kVectors; ++v) y[v] = V::load(g + v * V::kLanes);
    SKEL_UNROLL for (int r = 0; r < kRows; ++r) {
      const typename V::Vector a = V::broadcast(x[r]);
      SKEL_UNROLL for (int v = 0; v < kVectors; ++v) sum[r][v] = V::multiplyAdd(a, y[v], sum[r][v]);
    }
  }
  SKEL_UNROLL for (int v = 0; v < kVectors; ++v) {
    SKEL_UNROLL for (int r = 0; r < kRows; ++r) V::store(to[v] + r * kWeightPanel, sum[r][v]);
  }
}

void gradientPixels(const GradientTask& task) {
  // So many pixels that both strips stay in the first cache while all taps pass over them.
  const int channels = task.in_channels > task.out_channels ? task.in_channels : task.out_channels;
  const long block = 4096 / channels;
  for (long p = 0; p < task.pixels; p += block) {
    const long count = task.pixels - p < block ? task.pixels - p : block;
    for (int t = 0; t < task.taps; ++t) {
      for (int c = 0; c < task.in_channels; c += SKEL_GRADIENT_ROWS) {
        int n = 0;
        for (; n + 2 * V::kLanes <= task.out_channels; n += 2 * V::kLanes) {
          gradientTile<SKEL_GRADIENT_ROWS, 2>(task, t, p, count, c, n);
        }
        for (; n + V::kLanes <= task.out_channels; n += V::kLanes) {
          gradientTile<SKEL_GRADIENT_ROWS, 1>(task, t, p, count, c, n);
        }
      }
    }
  }
}

}  // namespace
}  // namespace skel
