// Vectors of numbers for the inner loops of the net, and code for whatever vector width the processor has.
#pragma once

#include <cstdint>
#include <type_traits>

// SKEL_WIDE before a function that is not a template: it is compiled for AVX2 as well, and the program takes
// that version where the processor has it. Both give the same bits, since lanes never mix and products are
// not fused (-ffp-contract=off). Sanitizers do not get along with the choice at load time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SKEL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SKEL_WIDE
#endif
// Before a template that such functions call, so that it is compiled for the same processor.
#define SKEL_INLINE [[gnu::always_inline]] inline

namespace skel {

inline constexpr int kLaneBytes = 32;
using FloatLanes = float __attribute__((vector_size(kLaneBytes)));
using DoubleLanes = double __attribute__((vector_size(kLaneBytes)));

template <class Value>
struct LaneTraits;
template <>
struct LaneTraits<float> {
  using Scalar = float;
  using Bits = std::uint32_t;
  using Lanes = FloatLanes;
};
template <>
struct LaneTraits<double> {
  using Scalar = double;
  using Bits = std::uint64_t;
  using Lanes = DoubleLanes;
};
template <>
struct LaneTraits<FloatLanes> {
  using Scalar = float;
  using Bits = std::uint32_t __attribute__((vector_size(kLaneBytes)));
};
template <>
struct LaneTraits<DoubleLanes> {
  using Scalar = double;
  using Bits = std::uint64_t __attribute__((vector_size(kLaneBytes)));
};
template <class Value>
using ScalarOf = typename LaneTraits<Value>::Scalar;
template <class Value>
using BitsOf = typename LaneTraits<Value>::Bits;
// kLaneBytes of Scalars.
template <class Scalar>
using Lanes = typename LaneTraits<Scalar>::Lanes;
template <class Scalar>
inline constexpr int kLaneCount = kLaneBytes / sizeof(Scalar);

// Unaligned.
template <class Scalar>
SKEL_INLINE Lanes<Scalar> load(const Scalar* from) {
  Lanes<Scalar> lanes;
  __builtin_memcpy(&lanes, from, kLaneBytes);
  return lanes;
}
template <class Scalar>
SKEL_INLINE void store(Scalar* to, Lanes<Scalar> lanes) {
  __builtin_memcpy(to, &lanes, kLaneBytes);
}

}  // namespace skel
