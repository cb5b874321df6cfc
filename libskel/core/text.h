// Words for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skel {

// With commas in between.
std::string joined(const std::vector<std::string>& words);

// Text out of a file as people are shown it: it neither ends (\x00) nor begins a line of its own (\n, \u2028)
// nor commands a terminal (\x1b) nor turns what follows around (\u202e); bytes that are no UTF-8 are shown as
// such (\xe4). Errors do so by themselves.
std::string printable(std::string_view text);

// The same, and of more than 600 bytes without its middle, where a value out of a file makes it long: the
// file and the place come first, what to do last.
std::string messageLine(std::string_view text);

// The first as printable(), and how many there are besides: "a.json (and 3 more)". At least one.
std::string firstAndMore(const std::vector<std::string>& texts);

// The first `most` as printable(), and how many there are besides: "a, b, c and 2 more".
std::string firstFew(std::vector<std::string> texts, std::size_t most = 4);

}  // namespace skel
