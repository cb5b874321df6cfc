#include "libskel/cli/outputs.h"

#include <string>
#include <vector>

#include "libskel/core/standard_output.h"

namespace skel {
namespace {

constexpr const char *kOutputMark = "output", *kPickedMark = "picked";

// Accepts every text, and does not show in --help.
CLI::Validator mark(const char* name) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", name);
}
}  // namespace

CLI::Validator outputFile() { return mark(kOutputMark); }
CLI::Validator pickedFiles() { return mark(kPickedMark); }

namespace {

// The outputs are added to `outputs`.
void noteFiles(const CLI::App& app, std::vector<std::string>& outputs) {
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
    if (output) outputs.insert(outputs.end(), files.begin(), files.end());
  }
  for (const CLI::App* command : app.get_subcommands()) noteFiles(*command, outputs);
}

}  // namespace

void noteFiles(const CLI::App& app) {
  std::vector<std::string> outputs;
  noteFiles(app, outputs);
  keepStandardOutputFor(outputs);
}

}  // namespace skel
