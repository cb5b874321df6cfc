// Number options. Each says where it is bound which numbers it takes; runTool() does not start a tool with
// one that does not. CLI::Range lets "nan" pass.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <initializer_list>
#include <sstream>
#include <string>

namespace skel {

// Of all validators below.
inline constexpr const char* kNumberCheck = "number";

// In [low, high], both ends included.
template <class Number>
CLI::Validator numberIn(Number low, Number high) {
  std::ostringstream range;
  range << "[" << low << " - " << high << "]";
  return CLI::Validator(
      [=, range = range.str()](const std::string& text) {
        Number number{};
        const bool good = CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
        return good ? std::string() : "Value " + text + " not in range " + range;
      },
      "in " + range.str(), kNumberCheck);
}

// 0, which means something else than a small number, or in [low, high].
template <class Number>
CLI::Validator zeroOrNumberIn(Number low, Number high) {
  std::ostringstream range;
  range << "0 or [" << low << " - " << high << "]";
  return CLI::Validator(
      [=, range = range.str()](const std::string& text) {
        Number number{};
        const bool good =
            CLI::detail::lexical_cast(text, number) && (number == 0 || (number >= low && number <= high));
        return good ? std::string() : "Value " + text + " is not " + range;
      },
      range.str(), kNumberCheck);
}

// Any seed that JSON can tell exactly.
inline CLI::Validator seedNumber() { return numberIn(std::uint64_t{0}, std::uint64_t{1} << 53); }

// One of these.
inline CLI::Validator oneOfNumbers(std::initializer_list<int> numbers) {
  return CLI::IsMember(numbers).name(kNumberCheck);
}

// Stops the program, and names the option, if a number option of `app` or of a subcommand takes whatever is
// typed: a mistake of ours, which no tool starts with.
void requireNumberChecks(CLI::App& app);

}  // namespace skel
