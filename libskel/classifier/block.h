// How the net is computed, here and in training: blocks of samples, one after the other, each layer for the
// whole block at once. A block's size is fixed and the sigmoid is our own, so that no result depends on the
// number of samples, the number of threads, the cache or the C library of the machine.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace skel {

inline constexpr int kBlockSize = 64;

// A sample a row, a unit a column.
template <class Scalar>
using Block = Eigen::Array<Scalar, kBlockSize, Eigen::Dynamic>;

// 1 / (1 + exp(-x)) in (0, 1), to a few units in the last place; x beyond ±16 (float) or ±36 (double) counts
// as that, where the next step would be 1. exp: x = n ln 2 + r (Cody & Waite 1980), Taylor's series of r, 2^n
// put into the exponent's bits.
template <class Scalar>
inline Scalar sigmoid(Scalar x) {
  constexpr bool kSingle = std::is_same_v<Scalar, float>;
  using Bits = std::conditional_t<kSingle, std::uint32_t, std::uint64_t>;
  constexpr Scalar kLimit = kSingle ? Scalar(16) : Scalar(36);
  constexpr Scalar kLog2E = Scalar(1.4426950408889634074);
  // ln 2 = high + low, where n times high is exact.
  constexpr Scalar kLn2High = kSingle ? Scalar(0.693359375) : Scalar(0.693147180369123816490);
  constexpr Scalar kLn2Low = kSingle ? Scalar(-2.12194440054690583e-4) : Scalar(1.90821492927058770002e-10);
  // Added to a small number, it leaves the nearest whole number in the lowest bits.
  constexpr Scalar kRounder = kSingle ? Scalar(12582912) : Scalar(6755399441055744);
  constexpr int kExponentShift = kSingle ? 23 : 52;
  constexpr Bits kOne = std::bit_cast<Bits>(Scalar(1));
  constexpr int kTerms = kSingle ? 6 : 13;

  x = x < kLimit ? x : kLimit;
  x = x > -kLimit ? x : -kLimit;
  const Scalar shifted = -x * kLog2E + kRounder;
  const Scalar n = shifted - kRounder;
  const Scalar r = (-x - n * kLn2High) - n * kLn2Low;
  Scalar series = 1;
#pragma GCC unroll 16
  for (int k = kTerms; k > 0; --k) series = 1 + series * r * (Scalar(1) / Scalar(k));
  const Scalar power_of_two =
      std::bit_cast<Scalar>(static_cast<Bits>((std::bit_cast<Bits>(shifted) << kExponentShift) + kOne));
  return 1 / (1 + series * power_of_two);
}

// outputs.col(j) = sigmoid(inputs · weights.row(j) + biases[j]). weights: outputs × inputs.
template <class Scalar, class Weights, class Biases>
inline void forwardBlock(const Weights& weights, const Biases& biases, const Block<Scalar>& inputs,
                         Block<Scalar>& outputs) {
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    Scalar sum[kBlockSize];
    for (int s = 0; s < kBlockSize; ++s) sum[s] = biases[j];
    for (Eigen::Index i = 0; i < weights.cols(); ++i) {
      const Scalar weight = weights(j, i);
      const Scalar* input = inputs.data() + i * kBlockSize;
      for (int s = 0; s < kBlockSize; ++s) sum[s] += weight * input[s];
    }
    Scalar* output = outputs.data() + j * kBlockSize;
    for (int s = 0; s < kBlockSize; ++s) output[s] = sigmoid(sum[s]);
  }
}

}  // namespace skel
