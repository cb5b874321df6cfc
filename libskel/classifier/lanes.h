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

// kCount numbers that are computed together.
template <class Scalar, int kCount>
struct LaneVector {
  typedef Scalar Type __attribute__((vector_size(kCount * sizeof(Scalar))));
};
template <class Scalar, int kCount>
using Lanes = typename LaneVector<Scalar, kCount>::Type;
// As many as AVX2 takes.
template <class Scalar>
inline constexpr int kLaneCount = 32 / sizeof(Scalar);

// Of a number or of Lanes: the type of one, and whole numbers of the same size.
template <class Value>
struct LaneTraits {
  using Scalar = std::remove_cvref_t<decltype(Value{}[0])>;
  using Bits = Lanes<std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>,
                     sizeof(Value) / sizeof(Scalar)>;
};
template <>
struct LaneTraits<float> {
  using Scalar = float;
  using Bits = std::uint32_t;
};
template <>
struct LaneTraits<double> {
  using Scalar = double;
  using Bits = std::uint64_t;
};
template <class Value>
using ScalarOf = typename LaneTraits<Value>::Scalar;
template <class Value>
using BitsOf = typename LaneTraits<Value>::Bits;

// Unaligned.
template <int kCount, class Scalar>
SKEL_INLINE Lanes<Scalar, kCount> load(const Scalar* from) {
  Lanes<Scalar, kCount> lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Value>
SKEL_INLINE void store(ScalarOf<Value>* to, Value lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

}  // namespace skel
