#include "libskel/core/natural_order.h"

#include <cctype>

namespace skel {

bool comesBefore(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
      continue;
    }
    const auto number = [&](const std::string& text, size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const size_t first = at;
      while (at < text.size() && isDigit(text[at])) ++at;
      return text.substr(first, at - first);
    };
    const std::string m = number(a, i), n = number(b, k);
    if (m.size() != n.size()) return m.size() < n.size();
    if (m != n) return m < n;
  }
  // "a1" and "a01": any order, but always the same.
  return i < a.size() || k < b.size() ? k < b.size() : a < b;
}

}  // namespace skel
