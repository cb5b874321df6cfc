#include "libskel/core/text.h"

namespace skel {
namespace {

struct Character {
  char32_t code;
  std::size_t bytes;
};

// The first character of UTF-8; of what is none, a byte.
Character firstOf(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::size_t count = byte(0) < 0xc2   ? 1
                            : byte(0) < 0xe0 ? 2
                            : byte(0) < 0xf0 ? 3
                            : byte(0) < 0xf5 ? 4
                                             : 1;
  if (count == 1 || text.size() < count) return {byte(0), 1};
  char32_t code = byte(0) & (0xffu >> (count + 1));
  for (std::size_t k = 1; k < count; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return {byte(0), 1};
    code = code << 6 | (byte(k) & 0x3f);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[count] || surrogate || code > 0x10ffff) return {byte(0), 1};
  return {code, count};
}

// Turns text around, or ends its line.
bool ordersText(char32_t code) {
  return code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

std::string hex(char32_t code, int digits) {
  std::string text;
  while (digits-- > 0) text += "0123456789abcdef"[code >> 4 * digits & 15];
  return text;
}

}  // namespace

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [code, bytes] = firstOf(text);
    if (code == '\n')
      out += "\\n";
    else if (code < 0x20 || (code >= 0x7f && code < 0xa0) || (bytes == 1 && code >= 0x80))
      out += "\\x" + hex(code, 2);
    else if (ordersText(code))
      out += "\\u" + hex(code, 4);
    else
      out += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return out;
}

std::string messageLine(std::string_view text) {
  constexpr std::size_t kFirst = 500, kLast = 100;
  const std::string line = printable(text);
  if (line.size() <= kFirst + kLast) return line;
  std::size_t end = kFirst, begin = line.size() - kLast;
  const auto isInside = [&](std::size_t at) { return (line[at] & 0xc0) == 0x80; };  // a character of UTF-8
  while (isInside(end)) --end;
  while (begin < line.size() && isInside(begin)) ++begin;
  return line.substr(0, end) + "…" + line.substr(begin);
}

std::string firstAndMore(const std::vector<std::string>& texts) {
  return printable(texts.front()) +
         (texts.size() > 1 ? " (and " + std::to_string(texts.size() - 1) + " more)" : "");
}

std::string firstFew(std::vector<std::string> texts, std::size_t most) {
  const std::size_t more = texts.size() - std::min(texts.size(), most);
  texts.resize(texts.size() - more);
  return printable(joined(texts)) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace skel
