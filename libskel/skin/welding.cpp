#include "libskel/skin/welding.h"

#include <algorithm>
#include <numeric>

namespace skel {

// By sorting: places can be chosen so that their hashes collide.
Welding::Welding(const Eigen::MatrixX3f& vertices) {
  const auto count = static_cast<std::size_t>(vertices.rows());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  const auto comparePlaces = [&](int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (vertices(a, k) != vertices(b, k)) return vertices(a, k) < vertices(b, k) ? -1 : 1;
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const int compared = comparePlaces(a, b);
    return compared != 0 ? compared < 0 : a < b;
  });
  std::vector<int> first(count);  // vertex at the same place
  for (std::size_t i = 0; i < count; ++i)
    first[static_cast<std::size_t>(order[i])] = i > 0 && comparePlaces(order[i - 1], order[i]) == 0
                                                    ? first[static_cast<std::size_t>(order[i - 1])]
                                                    : order[i];
  places_.reserve(count);
  for (std::size_t v = 0; v < count; ++v) {
    const bool is_first = first[v] == static_cast<int>(v);
    places_.push_back(is_first ? static_cast<int>(vertices_.size())
                               : places_[static_cast<std::size_t>(first[v])]);
    if (is_first) vertices_.push_back(static_cast<int>(v));
  }
}

}  // namespace skel
