// Words for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skel {

// With commas in between.
std::string joined(const std::vector<std::string>& words);

// Text out of a file as people are shown it: it neither ends (\x00) nor begins a line of its own (\n) nor
// commands a terminal (\x1b). Errors do so by themselves.
std::string printable(std::string_view text);

// Text out of a file may neither begin a line of its own nor command a terminal.
inline std::string printable(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f)
      out += c;
    else if (c == '\n')
      out += "\\n";
    else
      out += {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return out;
}

}  // namespace skel
