#include "libskel/image/mask_parts.h"

#include <algorithm>

namespace skel {

int MaskParts::largest() const {
  return size.empty() ? -1 : static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
}

MaskParts maskParts(const Plane8& mask) {
  MaskParts parts;
  std::vector<int> root;
  const auto find = [&](int run) {
    while (root[run] != run) run = root[run] = root[root[run]];
    return run;
  };
  const auto columns = static_cast<int>(mask.cols());
  std::size_t above = 0;  // the first run of the row above that may touch the next one
  for (int y = 0; y < mask.rows(); ++y) {
    const std::size_t row_begin = parts.runs.size();
    const std::uint8_t* row = mask.data() + mask.cols() * y;
    for (int x = 0; x < columns;) {
      if (row[x] == 0) {
        ++x;
        continue;
      }
      const int x0 = x;
      while (x < columns && row[x] != 0) ++x;
      const auto own = static_cast<int>(parts.runs.size());
      parts.runs.push_back({y, x0, x, 0});
      root.push_back(own);
      while (above < row_begin && parts.runs[above].x1 <= x0) ++above;
      for (std::size_t k = above; k < row_begin && parts.runs[k].x0 < x; ++k) {
        const int a = find(static_cast<int>(k)), b = find(own);
        root[std::max(a, b)] = std::min(a, b);
      }
    }
    above = row_begin;
  }
  std::vector<int> part_of_root(root.size(), -1);
  for (std::size_t k = 0; k < root.size(); ++k) {
    int& part = part_of_root[find(static_cast<int>(k))];
    if (part < 0) part = static_cast<int>(parts.size.size()), parts.size.push_back(0);
    parts.runs[k].part = part;
    parts.size[part] += parts.runs[k].x1 - parts.runs[k].x0;
  }
  return parts;
}

}  // namespace skel
