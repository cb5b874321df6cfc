#include "libskel/core/rng.h"

#include <cmath>

namespace skel {

Rng::Rng(std::uint64_t seed, std::uint64_t stream) : increment_((stream << 1) | 1) {
  next();
  state_ += seed;
  next();
}

std::uint32_t Rng::next() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + increment_;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto turn = static_cast<std::uint32_t>(old >> 59);
  return (shifted >> turn) | (shifted << ((32 - turn) & 31));
}

double Rng::uniform() { return next() * 0x1p-32; }

std::uint32_t Rng::below(std::uint32_t count) {
  const std::uint32_t threshold = (0u - count) % count;
  for (;;) {
    const std::uint32_t value = next();
    if (value >= threshold) return value % count;
  }
}

double Rng::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(6.283185307179586 * uniform());
}

}  // namespace skel
