// Options whose number is of all files, or of single ones.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace skel {

struct NamedNumbers {
  double of_others = 0;
  std::map<std::string, double> of = {};  // by the name of a file, without folder and ending

  double operator()(const std::string& name) const {
    const auto own = of.find(name);
    return own == of.end() ? of_others : own->second;
  }
  // Where `of_others` is no number: nobody has said any.
  std::optional<double> given(const std::string& name) const {
    const double number = (*this)(name);
    return std::isnan(number) ? std::nullopt : std::optional(number);
  }
};

// `--angle 20,cat=90`: a number of all, NAME=NUMBER of one; each must pass `check` (number.h).
CLI::Option* addNamedNumbers(CLI::App& app, const std::string& option, NamedNumbers& numbers,
                             const CLI::Validator& check, const std::string& description);

// Throws UsageError where one is of a file that is not called like any of `files`, paths.
void requireNamed(const NamedNumbers& numbers, const std::string& option,
                  const std::vector<std::string>& files);

}  // namespace skel
