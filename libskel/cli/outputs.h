// Options that name a file which a tool writes say so: ->check(outputFile()). Every other word of the command
// line that names a file names an input (input_guard.h): who forgets the mark is refused as soon as the file
// is there.
#pragma once

#include <CLI/CLI.hpp>

#include "libskel/core/input_guard.h"

namespace skel {

inline constexpr const char *kOutputMark = "output", *kPickedMark = "picked";

// Accepts every text, and does not show in --help.
inline CLI::Validator mark(const char* name) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", name);
}
inline CLI::Validator outputFile() { return mark(kOutputMark); }
// Inputs, not all of which are taken: the tool calls noteInput() for those that are.
inline CLI::Validator pickedFiles() { return mark(kPickedMark); }

// Notes the files and pipes that the command line names, and the outputs' defaults. Throws UsageError where
// an output is an input.
inline void noteFiles(const CLI::App& app) {
  const auto has = [](const CLI::Option& option, const char* mark) {
    try {
      return const_cast<CLI::Option&>(option).get_validator(mark) != nullptr;
    } catch (const CLI::OptionNotFound&) {
      return false;
    }
  };
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& word : option->results()) notePipe(word);
    if (has(*option, kPickedMark)) continue;
    const bool output = has(*option, kOutputMark);
    std::vector<std::string> files = option->results();
    if (files.empty() && output && !option->get_default_str().empty()) files = {option->get_default_str()};
    for (const std::string& file : files) output ? noteNamedOutput(file) : noteInput(file);
  }
  for (const CLI::App* command : app.get_subcommands()) noteFiles(*command);
}

}  // namespace skel
