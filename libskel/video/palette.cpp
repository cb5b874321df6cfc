// S. Wan, S. Wong, P. Prusinkiewicz, "An algorithm for multidimensional data clustering" (1988): the box of
// colours with the largest sum of squared deviations is cut in two, at the place along one axis that leaves
// the least of it.
#include "libskel/video/palette.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "libskel/core/check.h"

namespace skel {
namespace {

// Colours that agree in their upper five bits are one.
constexpr int kBits = 5, kCells = 1 << (3 * kBits);

int cellOf(const Rgb& c) {
  return (c[0] >> (8 - kBits)) << (2 * kBits) | (c[1] >> (8 - kBits)) << kBits | c[2] >> (8 - kBits);
}

struct Cell {
  int cell;
  double count;
  std::array<double, 3> sum;

  double mean(int axis) const { return sum[static_cast<size_t>(axis)] / count; }
};

struct Moments {
  double count = 0, square = 0;
  std::array<double, 3> sum{};

  void add(const Cell& c, double sign = 1) {
    count += sign * c.count;
    for (size_t k = 0; k < 3; ++k) {
      sum[k] += sign * c.sum[k];
      square += sign * c.sum[k] * c.sum[k] / c.count;
    }
  }
  // Sum of squared deviations from the mean.
  double deviation() const {
    if (count <= 0) return 0;
    double result = square;
    for (size_t k = 0; k < 3; ++k) result -= sum[k] * sum[k] / count;
    return std::max(result, 0.0);
  }
};

struct Box {
  size_t first, last;  // of the cells
  double deviation;
  bool operator<(const Box& other) const {
    return deviation != other.deviation ? deviation < other.deviation : first > other.first;
  }
};

Moments momentsOf(const std::vector<Cell>& cells, size_t first, size_t last) {
  Moments moments;
  for (size_t i = first; i < last; ++i) moments.add(cells[i]);
  return moments;
}

// Sorts the box's cells along the best axis and returns where its second half begins.
size_t cut(std::vector<Cell>& cells, const Box& box) {
  const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(box.first);
  const auto end = cells.begin() + static_cast<std::ptrdiff_t>(box.last);
  const auto sortAlong = [&](int axis) {
    std::sort(begin, end, [axis](const Cell& a, const Cell& b) {
      return a.mean(axis) != b.mean(axis) ? a.mean(axis) < b.mean(axis) : a.cell < b.cell;
    });
  };
  double least = std::numeric_limits<double>::infinity();
  size_t best = box.first + 1;
  int best_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sortAlong(axis);
    Moments low, high = momentsOf(cells, box.first, box.last);
    for (size_t i = box.first; i + 1 < box.last; ++i) {
      low.add(cells[i]);
      high.add(cells[i], -1);
      const double left = low.deviation() + high.deviation();
      if (left < least) least = left, best = i + 1, best_axis = axis;
    }
  }
  sortAlong(best_axis);
  return best;
}

}  // namespace

Palette choosePalette(const std::vector<Rgb>& pixels, int max_colors) {
  SKEL_CHECK(max_colors >= 1 && max_colors <= 256);
  std::vector<int> slot(kCells, -1);
  std::vector<Cell> cells;
  for (const Rgb& pixel : pixels) {
    int& s = slot[static_cast<size_t>(cellOf(pixel))];
    if (s < 0) {
      s = static_cast<int>(cells.size());
      cells.push_back({cellOf(pixel), 0, {}});
    }
    Cell& cell = cells[static_cast<size_t>(s)];
    cell.count += 1;
    for (size_t k = 0; k < 3; ++k) cell.sum[k] += pixel[k];
  }

  Palette palette;
  std::priority_queue<Box> boxes;
  std::vector<Box> done;
  if (!cells.empty()) boxes.push({0, cells.size(), momentsOf(cells, 0, cells.size()).deviation()});
  while (!boxes.empty()) {
    const Box box = boxes.top();
    boxes.pop();
    if (box.last - box.first < 2 || static_cast<int>(boxes.size() + done.size()) + 2 > max_colors) {
      done.push_back(box);
      continue;
    }
    const size_t middle = cut(cells, box);
    boxes.push({box.first, middle, momentsOf(cells, box.first, middle).deviation()});
    boxes.push({middle, box.last, momentsOf(cells, middle, box.last).deviation()});
  }
  std::vector<std::uint8_t> index(kCells, 0);
  for (const Box& box : done) {
    const Moments moments = momentsOf(cells, box.first, box.last);
    for (size_t i = box.first; i < box.last; ++i)
      index[static_cast<size_t>(cells[i].cell)] = static_cast<std::uint8_t>(palette.colors.size());
    Rgb color;
    for (size_t k = 0; k < 3; ++k) color[k] = static_cast<std::uint8_t>(moments.sum[k] / moments.count + 0.5);
    palette.colors.push_back(color);
  }
  palette.indices.reserve(pixels.size());
  for (const Rgb& pixel : pixels) palette.indices.push_back(index[static_cast<size_t>(cellOf(pixel))]);
  return palette;
}

}  // namespace skel
