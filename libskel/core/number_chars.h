// Floating point numbers to and from characters, as <charconv> has them, also where the standard library's
// knows whole numbers alone. Independent of the locale that a program may have set, as long as its decimal
// point is a dot.
#pragma once

#include <charconv>
#ifndef __cpp_lib_to_chars
#include <cstdio>
#include <cstdlib>
#include <string>
#endif

namespace skel {

#ifdef __cpp_lib_to_chars

using std::from_chars;

// The shortest text that reads back as the same number.
inline char* shortestChars(char* begin, char* end, float value) {
  return std::to_chars(begin, end, value).ptr;
}
inline char* shortestChars(char* begin, char* end, double value) {
  return std::to_chars(begin, end, value).ptr;
}

inline char* fixedChars(char* begin, char* end, double value, int digits) {
  return std::to_chars(begin, end, value, std::chars_format::fixed, digits).ptr;
}

#else

namespace number_chars {
inline void parse(const char* text, char** end, float& value) { value = std::strtof(text, end); }
inline void parse(const char* text, char** end, double& value) { value = std::strtod(text, end); }
}  // namespace number_chars

template <class Number>
std::from_chars_result from_chars(const char* begin, const char* end, Number& value) {
  const std::string text(begin, end);
  const bool number = !text.empty() && text.find_first_not_of("0123456789.+-eE") == std::string::npos;
  char* stop = nullptr;
  if (number && text[0] != '+') number_chars::parse(text.c_str(), &stop, value);
  if (!stop || stop == text.c_str()) return {begin, std::errc::invalid_argument};
  return {begin + (stop - text.c_str()), std::errc()};
}

template <class Number>
char* shortestChars(char* begin, char* end, Number value) {
  const auto size = static_cast<std::size_t>(end - begin);
  int length = 0;
  for (int digits = 1; digits <= 17; ++digits) {
    length = std::snprintf(begin, size, "%.*g", digits, static_cast<double>(value));
    Number back;
    number_chars::parse(begin, nullptr, back);
    if (back == value) break;
  }
  return begin + length;
}

inline char* fixedChars(char* begin, char* end, double value, int digits) {
  return begin + std::snprintf(begin, static_cast<std::size_t>(end - begin), "%.*f", digits, value);
}

#endif

}  // namespace skel
