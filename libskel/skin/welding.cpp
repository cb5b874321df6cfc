#include "libskel/skin/welding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace skel {

Welding::Welding(const Eigen::MatrixX3f& vertices) {
  const auto count = static_cast<std::size_t>(vertices.rows());
  // An open hash table, twice as long as needed at least.
  const std::size_t size = std::bit_ceil(2 * count + 1);
  std::vector<int> table(size, -1);
  places_.reserve(count);
  for (std::size_t v = 0; v < count; ++v) {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      const float c = vertices(static_cast<Eigen::Index>(v), k) + 0.0f;  // −0 is 0
      hash = (hash ^ __builtin_bit_cast(std::uint32_t, c)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    std::size_t slot = hash & (size - 1);
    while (table[slot] >= 0 && (vertices.row(vertices_[static_cast<std::size_t>(table[slot])]).array() !=
                                vertices.row(static_cast<Eigen::Index>(v)).array())
                                   .any())
      slot = (slot + 1) & (size - 1);
    if (table[slot] < 0) {
      table[slot] = static_cast<int>(vertices_.size());
      vertices_.push_back(static_cast<int>(v));
    }
    places_.push_back(table[slot]);
  }
}

}  // namespace skel
