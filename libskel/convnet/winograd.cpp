#include "libskel/convnet/winograd.h"

#include <algorithm>
#include <array>

#include "libskel/convnet/conv_kernels_sets.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

constexpr int kTilesAtATime = 64;  // so many that what they are made into stays in the second cache

}  // namespace

bool suitsWinograd(const ConvShape& shape) {
  return shape.kernel == 3 && shape.in_channels % 16 == 0 && shape.out_channels % kWeightPanel == 0;
}

void winogradWeights(const ConvShape& shape, const float* weights, float* transformed) {
  SKEL_CHECK(suitsWinograd(shape));
  const std::size_t block = static_cast<std::size_t>(shape.in_channels) * kWeightPanel,
                    plane = static_cast<std::size_t>(shape.in_channels * shape.out_channels);
  // G applied to three rows of kWeightPanel numbers that lie `from_step` apart gives four, `to_step` apart.
  const auto applyG = [](const float* from, std::size_t from_step, float* to, std::size_t to_step) {
    for (std::size_t k = 0; k < kWeightPanel; ++k) {
      const float a = from[k], b = from[from_step + k], c = from[2 * from_step + k];
      to[k] = a;
      to[to_step + k] = .5f * (a + b + c);
      to[2 * to_step + k] = .5f * (a - b + c);
      to[3 * to_step + k] = c;
    }
  };
  std::array<float, 12 * kWeightPanel> half;  // Gg of one input channel, column by column
  for (std::size_t panel = 0; panel * kWeightPanel < static_cast<std::size_t>(shape.out_channels); ++panel) {
    for (std::size_t in = 0; in < block; in += kWeightPanel) {
      const float* g = weights + 9 * panel * block + in;
      float* u = transformed + panel * block + in;
      for (std::size_t x = 0; x < 3; ++x)
        applyG(g + x * block, 3 * block, half.data() + x * kWeightPanel, 3 * kWeightPanel);
      for (std::size_t i = 0; i < 4; ++i)
        applyG(half.data() + 3 * i * kWeightPanel, kWeightPanel, u + 4 * i * plane, plane);
    }
  }
}

void convolveWinograd(InstructionSet set, const ConvShape& shape, const float* in, const float* transformed,
                      const float* bias, const float* skip, bool relu, float* out,
                      std::vector<float>& scratch) {
  checkShape(set, shape);
  SKEL_CHECK(suitsWinograd(shape));
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
