// The transforms of winograd.h over a vector type; see conv_kernels_impl.h, which comes before this file.
#pragma once

namespace skel {
namespace {

// 4×4 inputs of each tile of `rows` rows: BᵀdB.
void transformTiles(const WinogradTask& task, int first_row, int rows) {
  const int channels = task.in_channels;
  const long plane = static_cast<long>(rows) * task.tiles_across * channels;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < task.tiles_across; ++column) {
      const float* in[4][4];
      for (int y = 0; y < 4; ++y) {
        // Beyond the map's border nothing counts: it only reaches outputs that are not there.
        int from_y = 2 * (first_row + row) + y - 1;
        if (from_y > task.height) from_y = task.height;
        for (int x = 0; x < 4; ++x) {
          int from_x = 2 * column + x - 1;
          if (from_x > task.width) from_x = task.width;
          in[y][x] = task.in + (static_cast<long>(from_y) * (task.width + 1) + from_x) * channels;
        }
      }
      float* out = task.tiles + static_cast<long>(row * task.tiles_across + column) * channels;
      for (int c = 0; c < channels; c += V::kLanes) {
        typename V::Vector down[4][4];
        SKEL_UNROLL for (int x = 0; x < 4; ++x) {
          const typename V::Vector d0 = V::load(in[0][x] + c), d1 = V::load(in[1][x] + c),
                                   d2 = V::load(in[2][x] + c), d3 = V::load(in[3][x] + c);
          down[0][x] = V::subtract(d0, d2);
          down[1][x] = V::add(d1, d2);
          down[2][x] = V::subtract(d2, d1);
          down[3][x] = V::subtract(d1, d3);
        }
        SKEL_UNROLL for (int y = 0; y < 4; ++y) {
          float* o = out + 4 * y * plane + c;
          V::store(o, V::subtract(down[y][0], down[y][2]));
          V::store(o + plane, V::add(down[y][1], down[y][2]));
          V::store(o + 2 * plane, V::subtract(down[y][2], down[y][1]));
          V::store(o + 3 * plane, V::subtract(down[y][1], down[y][3]));
        }
      }
    }
  }
}

// 2×2 outputs of each tile: AᵀmA, then bias, skip and max(0, ·).
void untransformTiles(const WinogradTask& task, int first_row, int rows) {
  const int channels = task.out_channels;
  const long plane = static_cast<long>(rows) * task.tiles_across * channels;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < task.tiles_across; ++column) {
      const float* in = task.products + static_cast<long>(row * task.tiles_across + column) * channels;
      const int to_y = 2 * (first_row + row), to_x = 2 * column;
      const int high = task.height - to_y < 2 ? 1 : 2, wide = task.width - to_x < 2 ? 1 : 2;
      const long to = (static_cast<long>(to_y) * (task.width + 1) + to_x) * channels;
      for (int c = 0; c < channels; c += V::kLanes) {
        typename V::Vector up[2][4];
        SKEL_UNROLL for (int x = 0; x < 4; ++x) {
          const float* m = in + x * plane + c;
          const typename V::Vector m0 = V::load(m), m1 = V::load(m + 4 * plane), m2 = V::load(m + 8 * plane),
                                   m3 = V::load(m + 12 * plane);
          up[0][x] = V::add(V::add(m0, m1), m2);
          up[1][x] = V::subtract(V::subtract(m1, m2), m3);
        }
        const typename V::Vector bias = task.bias ? V::load(task.bias + c) : V::zero();
        SKEL_UNROLL for (int y = 0; y < 2; ++y) {
          if (y >= high) break;
          const typename V::Vector sums[2] = {V::add(V::add(up[y][0], up[y][1]), up[y][2]),
                                              V::subtract(V::subtract(up[y][1], up[y][2]), up[y][3])};
          SKEL_UNROLL for (int x = 0; x < 2; ++x) {
            if (x >= wide) break;
            const long i = to + (static_cast<long>(y) * (task.width + 1) + x) * channels + c;
            typename V::Vector sum = V::add(sums[x], bias);
            if (task.skip) sum = V::add(sum, V::load(task.skip + i));
            if (task.relu) sum = V::maximum(sum, V::zero());
            V::store(task.out + i, sum);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace skel
