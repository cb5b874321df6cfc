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

}  // namespace skel
