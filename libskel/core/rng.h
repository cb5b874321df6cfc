// Random numbers that are the same on every machine for the same seed (PCG32, O'Neill 2014).
#pragma once

#include <cstdint>

namespace skel {

class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0);
  // Another stream that begins here; this one goes on as if there was none.
  Rng branch(std::uint64_t stream) const { return Rng(state_, stream); }
  std::uint32_t next();
  // In [0, 1).
  double uniform();
  // In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // In [0, count), without bias; count > 0.
  std::uint32_t below(std::uint32_t count);
  bool chance(double probability) { return uniform() < probability; }
  // Mean 0, deviation 1.
  double normal();
  double normal(double mean, double deviation) { return mean + deviation * normal(); }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

}  // namespace skel
