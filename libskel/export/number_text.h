// Numbers in text files.
#pragma once

#include <string>
#include <string_view>

#include "libskel/core/number_chars.h"

namespace skel {

// With at most `digits` decimals and no trailing zeros, the same on every machine and in every locale.
inline void appendNumber(std::string& text, double value, int digits = 6) {
  char buffer[64];
  char* end = fixedChars(buffer, buffer + sizeof buffer, value, digits);
  while (end[-1] == '0') --end;
  if (end[-1] == '.') --end;
  const std::string_view number(buffer, std::size_t(end - buffer));
  text += number == "-0" ? std::string_view("0") : number;
}

}  // namespace skel
