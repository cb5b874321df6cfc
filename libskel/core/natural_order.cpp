#include "libskel/core/natural_order.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace skel {
namespace {

// From U+00C0 to U+017F, without what is no letter: "." stands for itself.
constexpr std::string_view kWithoutMarks =
    "AAAAAAACEEEEIIIIDNOOOOO.OUUUUYTs"
    "aaaaaaaceeeeiiiidnooooo.ouuuuyty"
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlL"
    "lLlNnNnNnnNnOoOoOoOoRrRrRrSsSsSsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";

// Whatever the locale.
unsigned char small(char c) { return static_cast<unsigned char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); }

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// Below 0: `a` comes first. 0: they differ in capitals and in zeros before numbers at most.
int compared(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[k])) {
      if (small(a[i]) != small(b[k])) return small(a[i]) < small(b[k]) ? -1 : 1;
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
    if (m.size() != n.size()) return m.size() < n.size() ? -1 : 1;
    if (m != n) return m < n ? -1 : 1;
  }
  return static_cast<int>(i < a.size()) - static_cast<int>(k < b.size());
}

}  // namespace

std::string withoutMarks(const std::string& text) {
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const auto second = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool pair = (first & 0xE0) == 0xC0 && (second & 0xC0) == 0x80;
    const size_t code = pair ? static_cast<size_t>((first & 0x1F) << 6 | (second & 0x3F)) : 0;
    const bool is_mark = code >= 0x300 && code < 0x370;
    const bool is_letter =
        code >= 0xC0 && code - 0xC0 < kWithoutMarks.size() && kWithoutMarks[code - 0xC0] != '.';
    if (is_letter) plain += kWithoutMarks[code - 0xC0];
    if (is_letter || is_mark)
      ++i;
    else
      plain += text[i];
  }
  return plain;
}

bool comesBefore(const std::string& a, const std::string& b) {
  const int order = isAscii(a) && isAscii(b) ? compared(a, b) : compared(withoutMarks(a), withoutMarks(b));
  // "a1" and "a01", "Ann" and "Änn": any order, but always the same.
  return order != 0 ? order < 0 : a < b;
}

}  // namespace skel
