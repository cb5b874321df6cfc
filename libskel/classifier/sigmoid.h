// 1 / (1 + exp(-x)) that gives the same bits on every machine, for one number or for a vector of them.
#pragma once

#include <cstdint>
#include <type_traits>

#include "libskel/classifier/lanes.h"

namespace skel {

// Exact to a few units in the last place and always inside (0, 1): x beyond ±16 (float) or ±36 (double)
// counts as that, since the next step would be 1. Value is float, double or Lanes of them; several of them at
// once keep the processor busy, since each step waits for the one before. exp: -x = n ln 2 + r (Cody & Waite
// 1980), Taylor's series of r, 2^n put into the exponent's bits.
template <int kCount, class Value>
SKEL_INLINE void sigmoidInPlace(Value (&x)[kCount]) {
  using Scalar = ScalarOf<Value>;
  using Bits = BitsOf<Value>;
  constexpr bool kSingle = std::is_same_v<Scalar, float>;
  constexpr Scalar kLog2E = Scalar(1.4426950408889634074);
  // ln 2 = high + low, where n times high is exact.
  constexpr Scalar kLn2High = kSingle ? Scalar(0.693359375) : Scalar(0.693147180369123816490);
  constexpr Scalar kLn2Low = kSingle ? Scalar(-2.12194440054690583e-4) : Scalar(1.90821492927058770002e-10);
  // Added to a small number, it leaves the nearest whole number in the lowest bits.
  constexpr Scalar kRounder = kSingle ? Scalar(12582912) : Scalar(6755399441055744);
  constexpr int kExponentShift = kSingle ? 23 : 52;
  constexpr auto kOne = __builtin_bit_cast(BitsOf<Scalar>, Scalar(1));
  constexpr int kTerms = kSingle ? 6 : 13;
  constexpr Scalar kInverseFactorials[] = {Scalar(1.),
                                           Scalar(1.),
                                           Scalar(1. / 2),
                                           Scalar(1. / 6),
                                           Scalar(1. / 24),
                                           Scalar(1. / 120),
                                           Scalar(1. / 720),
                                           Scalar(1. / 5040),
                                           Scalar(1. / 40320),
                                           Scalar(1. / 362880),
                                           Scalar(1. / 3628800),
                                           Scalar(1. / 39916800),
                                           Scalar(1. / 479001600),
                                           Scalar(1. / 6227020800)};
  const Value limit = Value{} + (kSingle ? Scalar(16) : Scalar(36));

  // The even and the odd powers of r, so that two chains run side by side.
  Value shifted[kCount], square[kCount], even[kCount], odd[kCount];
#pragma GCC unroll 8
  for (int c = 0; c < kCount; ++c) {
    x[c] = x[c] < limit ? x[c] : limit;
    x[c] = x[c] > -limit ? x[c] : -limit;
    shifted[c] = kRounder - x[c] * kLog2E;
    const Value n = shifted[c] - kRounder;
    x[c] = (-x[c] - n * kLn2High) - n * kLn2Low;
    square[c] = x[c] * x[c];
    even[c] = Value{} + kInverseFactorials[kTerms];
    odd[c] = Value{} + kInverseFactorials[kTerms - 1];
  }
#pragma GCC unroll 8
  for (int k = kTerms - 2; k > 0; k -= 2)
#pragma GCC unroll 8
    for (int c = 0; c < kCount; ++c) {
      even[c] = kInverseFactorials[k] + even[c] * square[c];
      odd[c] = kInverseFactorials[k - 1] + odd[c] * square[c];
    }
#pragma GCC unroll 8
  for (int c = 0; c < kCount; ++c) {
    // kTerms even: `even` has one more step to go. Odd: the two have changed their places.
    const Value series =
        kTerms % 2 == 0 ? (1 + even[c] * square[c]) + odd[c] * x[c] : odd[c] + even[c] * x[c];
    const Value power_of_two =
        __builtin_bit_cast(Value, (__builtin_bit_cast(Bits, shifted[c]) << kExponentShift) + kOne);
    x[c] = 1 / (1 + series * power_of_two);
  }
}

template <class Value>
SKEL_INLINE Value sigmoid(Value x) {
  Value one[1] = {x};
  sigmoidInPlace(one);
  return one[0];
}

}  // namespace skel
