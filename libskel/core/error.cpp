#include "libskel/core/error.h"

#include "libskel/core/text.h"

namespace skel {
namespace {

// Without its middle where a value out of a file makes it long: the file and the place come first, what to do
// last.
std::string shortened(const std::string& message) {
  constexpr std::size_t kFirst = 500, kLast = 100;
  if (message.size() <= kFirst + kLast) return message;
  std::size_t end = kFirst, begin = message.size() - kLast;
  const auto isInside = [&](std::size_t at) { return (message[at] & 0xc0) == 0x80; };  // a character of UTF-8
  while (isInside(end)) --end;
  while (begin < message.size() && isInside(begin)) ++begin;
  return message.substr(0, end) + "…" + message.substr(begin);
}

}  // namespace

Error::Error(ExitCode exit_code, const std::string& message)
    : std::runtime_error(shortened(printable(message))), exit_code_(exit_code) {}

InputError::InputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kInput, file + ": " + problem), file_(file), problem_(problem) {}

OutputError::OutputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kOutput, file + ": " + problem) {}

}  // namespace skel
