#include "libskel/image/mask_parts.h"

#include <algorithm>
#include <cstring>

namespace skel {
namespace {

constexpr int kTogether = 8;

// Where the next byte from x on is not 0, or the row's end: most of a mask is empty.
int skipZeros(const std::uint8_t* row, int x, int end) {
  for (std::uint64_t bytes = 0; x + kTogether <= end; x += kTogether) {
    std::memcpy(&bytes, row + x, kTogether);
    if (bytes != 0) break;
  }
  while (x < end && row[x] == 0) ++x;
  return x;
}

}  // namespace

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
    for (int x = skipZeros(row, 0, columns); x < columns; x = skipZeros(row, x, columns)) {
      const int x0 = x;
      const void* zero = std::memchr(row + x, 0, static_cast<std::size_t>(columns - x));
      x = zero == nullptr ? columns : static_cast<int>(static_cast<const std::uint8_t*>(zero) - row);
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

std::vector<std::array<int, 256>> valuesBeside(const MaskParts& parts, const Plane8& figure,
                                               const Plane8& plane) {
  std::vector<std::array<int, 256>> beside(parts.size.size(), std::array<int, 256>{});
  Plane8 own = Plane8::Zero(figure.rows(), figure.cols());
  for (const MaskParts::Run& run : parts.runs) own.row(run.y).segment(run.x0, run.x1 - run.x0).setConstant(1);
  const auto touch = [&](int part, Eigen::Index y, Eigen::Index x) {
    if (y >= 0 && x >= 0 && y < figure.rows() && x < figure.cols() && figure(y, x) != 0 && own(y, x) == 0)
      ++beside[static_cast<std::size_t>(part)][plane(y, x)];
  };
  for (const MaskParts::Run& run : parts.runs) {
    touch(run.part, run.y, run.x0 - 1), touch(run.part, run.y, run.x1);
    for (int x = run.x0; x < run.x1; ++x) touch(run.part, run.y - 1, x), touch(run.part, run.y + 1, x);
  }
  return beside;
}

}  // namespace skel
