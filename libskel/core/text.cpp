#include "libskel/core/text.h"

namespace skel {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string printable(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto at = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    // U+0080 to U+009F, two bytes of UTF-8, are commands as well.
    const bool c1 = at(i) == 0xc2 && (at(i + 1) & 0xe0) == 0x80;
    const unsigned code = c1 ? at(++i) : at(i);
    if (!c1 && code >= 0x20 && code != 0x7f)
      out += text[i];
    else if (code == '\n')
      out += "\\n";
    else
      out += {'\\', 'x', kDigits[code / 16], kDigits[code % 16]};
  }
  return out;
}

}  // namespace skel
