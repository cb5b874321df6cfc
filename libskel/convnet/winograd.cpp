#include "libskel/convnet/winograd.h"

#include <algorithm>

#include "libskel/convnet/conv_kernels_sets.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr int kTilesAtATime = 64;  // so many that what they are made into stays in the second cache

}  // namespace

bool suitsWinograd(const ConvShape& shape) { return shape.kernel == 3 && shape.in_channels % 16 == 0; }

void winogradWeights(const ConvShape& shape, const float* weights, float* transformed) {
  SKEL_CHECK_EQ(shape.kernel, 3);
  constexpr float kG[4][3] = {{1, 0, 0}, {.5f, .5f, .5f}, {.5f, -.5f, .5f}, {0, 0, 1}};
  const std::size_t block = static_cast<std::size_t>(shape.in_channels) * kWeightPanel,
                    plane = static_cast<std::size_t>(shape.in_channels * shape.out_channels);
  std::vector<float> half(12 * kWeightPanel);  // Gg of one input channel
  for (int panel = 0; panel < shape.out_channels / kWeightPanel; ++panel) {
    for (int in = 0; in < shape.in_channels; ++in) {
      const float* g = weights + panel * 9 * block + static_cast<std::size_t>(in) * kWeightPanel;
      float* u = transformed + panel * block + static_cast<std::size_t>(in) * kWeightPanel;
      for (int i = 0; i < 4; ++i) {
        for (int x = 0; x < 3; ++x) {
          for (int k = 0; k < kWeightPanel; ++k)
            half[static_cast<std::size_t>((3 * i + x) * kWeightPanel + k)] =
                kG[i][0] * g[x * block + k] + kG[i][1] * g[(3 + x) * block + k] +
                kG[i][2] * g[(6 + x) * block + k];
        }
      }
      for (int i = 0; i < 4; ++i) {
        const float* h = half.data() + 3 * i * kWeightPanel;
        for (int j = 0; j < 4; ++j) {
          float* to = u + static_cast<std::size_t>(4 * i + j) * plane;
          for (int k = 0; k < kWeightPanel; ++k)
            to[k] = kG[j][0] * h[k] + kG[j][1] * h[kWeightPanel + k] + kG[j][2] * h[2 * kWeightPanel + k];
        }
      }
    }
  }
}

void convolveWinograd(InstructionSet set, const ConvShape& shape, const float* in, const float* transformed,
                      const float* bias, const float* skip, bool relu, float* out,
                      std::vector<float>& scratch) {
  SKEL_CHECK(hasInstructionSet(set) && suitsWinograd(shape));
  const ConvKernels& kernels = kernelsOf(set);
  const int tiles_across = (shape.width + 1) / 2, tiles_down = (shape.height + 1) / 2;
  const int rows_at_a_time = std::clamp(kTilesAtATime / tiles_across, 1, tiles_down);
  const auto most = static_cast<std::size_t>(rows_at_a_time * tiles_across);
  const std::size_t tile_floats = 16 * most * static_cast<std::size_t>(shape.in_channels);
  scratch.resize(
      std::max(scratch.size(), tile_floats + 16 * most * static_cast<std::size_t>(shape.out_channels)));

  const long first = paddedIndex(shape.width, 0, 0), channels = shape.out_channels;
  const WinogradTask task = {in + first * shape.in_channels,
                             shape.height,
                             shape.width,
                             tiles_across,
                             shape.in_channels,
                             shape.out_channels,
                             bias,
                             skip ? skip + first * channels : nullptr,
                             relu,
                             scratch.data(),
                             scratch.data() + tile_floats,
                             out + first * channels};
  const long here = 0;
  for (int row = 0; row < tiles_down; row += rows_at_a_time) {
    const int rows = std::min(rows_at_a_time, tiles_down - row);
    const long tiles = static_cast<long>(rows) * tiles_across;
    kernels.transform(task, row, rows);
    for (long k = 0; k < 16; ++k)
      kernels.convolve({task.tiles + k * tiles * shape.in_channels, &here, 1, shape.in_channels,
                        shape.out_channels, transformed + k * shape.in_channels * channels, nullptr, nullptr,
                        false, task.products + k * tiles * channels, tiles});
    kernels.untransform(task, row, rows);
  }
  clearPadding(shape, out);
}

}  // namespace skel
