// Options whose values are the names of something.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace skel {

template <class Value>
CLI::IsMember namesOf(const std::map<std::string, Value>& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.push_back(one.first);
  return CLI::IsMember(names);
}

// For a list with commas: what is before and behind a name is no part of it.
inline CLI::Validator withoutBlanks() {
  const auto trim = [](std::string& name) {
    CLI::detail::trim(name);
    return std::string();
  };
  return CLI::Validator(trim, "", "without_blanks");
}

}  // namespace skel
