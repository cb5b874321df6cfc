#include "libskel/core/json_names.h"

#include <cstddef>
#include <cstdint>

namespace skel {
namespace {

unsigned byteAt(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

// Bytes of the character of UTF-8 (RFC 3629) that starts at `i`; 0 if there is none.
std::size_t characterLength(std::string_view text, std::size_t i) {
  const unsigned first = byteAt(text, i);
  if (first < 0x80) return 1;
  if (first < 0xC0) return 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byteAt(text, i + k) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byteAt(text, i + k) & 0x3F);
  }
  const std::uint32_t least[] = {0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return first < 0xF8 && code >= least[length - 2] && code <= 0x10FFFF && !surrogate ? length : 0;
}

// U+EF80 … U+EFFF: EE BE 80 … EE BF BF.
bool isEscape(std::string_view text, std::size_t i) {
  return byteAt(text, i) == 0xEE && (byteAt(text, i + 1) & 0xFE) == 0xBE &&
         (byteAt(text, i + 2) & 0xC0) == 0x80;
}

}  // namespace

std::string jsonFromFileName(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t length = isEscape(name, i) ? 0 : characterLength(name, i);
    if (length > 0) {
      text += name.substr(i, length);
      i += length;
    } else {
      const unsigned byte = byteAt(name, i++);
      text += {'\xEE', static_cast<char>(0xBE | (byte >> 6 & 1)), static_cast<char>(0x80 | (byte & 0x3F))};
    }
  }
  return text;
}

std::string fileNameFromJson(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size();) {
    if (isEscape(text, i)) {
      name += static_cast<char>(0x80 | (byteAt(text, i + 1) & 1) << 6 | (byteAt(text, i + 2) & 0x3F));
      i += 3;
    } else {
      name += text[i++];
    }
  }
  return name;
}

}  // namespace skel
