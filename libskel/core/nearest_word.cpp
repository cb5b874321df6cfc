#include "libskel/core/nearest_word.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace skel {
namespace {

std::size_t steps(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = std::exchange(row[0], i + 1);
    for (std::size_t k = 0; k < b.size(); ++k)
      before =
          std::exchange(row[k + 1], std::min({row[k + 1] + 1, row[k] + 1, before + (a[i] == b[k] ? 0 : 1)}));
  }
  return row.back();
}

}  // namespace

std::string nearestWord(std::string_view typed, const std::vector<std::string>& words) {
  std::string nearest;
  std::size_t fewest = typed.size() + 1;
  for (const std::string& word : words)
    if (const std::size_t count = steps(typed, word); count * 3 <= word.size() && count < fewest)
      nearest = word, fewest = count;
  return nearest;
}

}  // namespace skel
