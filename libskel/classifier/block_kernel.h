// The inner loop of forwardBlock(), for functions that are compiled for several processors (see lanes.h).
#pragma once

#include "libskel/classifier/block.h"
#include "libskel/classifier/lanes.h"
#include "libskel/classifier/sigmoid.h"

namespace skel {

// Lanes of one block that are computed side by side.
inline constexpr int kLanesAtOnce = 4;

// weights: outputs × inputs, column by column. input: inputs columns of a block; output: outputs columns.
template <class Scalar>
SKEL_INLINE void forwardKernel(int inputs, int outputs, const Scalar* weights, const Scalar* biases,
                               const Scalar* input, Scalar* output) {
  constexpr int kLanes = kLaneCount<Scalar>;
  for (int j = 0; j < outputs; ++j)
    for (int s = 0; s < kBlockSize; s += kLanesAtOnce * kLanes) {
      Lanes<Scalar, kLanes> sums[kLanesAtOnce];
#pragma GCC unroll 8
      for (auto& sum : sums) sum = Lanes<Scalar, kLanes>{} + biases[j];
      for (int i = 0; i < inputs; ++i) {
        const auto weight = Lanes<Scalar, kLanes>{} + weights[i * outputs + j];
        const Scalar* from = input + i * kBlockSize + s;
#pragma GCC unroll 8
        for (int c = 0; c < kLanesAtOnce; ++c) sums[c] += weight * load<kLanes>(from + c * kLanes);
      }
      sigmoidInPlace(sums);
#pragma GCC unroll 8
      for (int c = 0; c < kLanesAtOnce; ++c) store(output + j * kBlockSize + s + c * kLanes, sums[c]);
    }
}

}  // namespace skel
