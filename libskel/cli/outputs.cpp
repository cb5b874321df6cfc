#include "libskel/cli/outputs.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/core/own_format.h"
#include "libskel/core/standard_output.h"

namespace skel {
namespace {

constexpr const char* kPickedMark = "picked";
constexpr std::string_view kOutputMark = "output ";  // and the format

// Accepts every text, and does not show in --help.
CLI::Validator mark(const std::string& name) {
  return CLI::Validator([](std::string&) { return std::string(); }, "", name);
}
}  // namespace

CLI::Validator outputFile(const std::string& format) { return mark(std::string(kOutputMark) + format); }
CLI::Validator pickedFiles() { return mark(kPickedMark); }

namespace {

struct NotedOutput {
  std::string file, format;
};

// What follows `mark` in an option that has it.
std::optional<std::string> marked(const CLI::Option& option, std::string_view mark) {
  try {
    for (int i = 0;; ++i)
      if (const std::string name = const_cast<CLI::Option&>(option).get_validator(i)->get_name();
          name.starts_with(mark))
        return name.substr(mark.size());
  } catch (const CLI::OptionNotFound&) {
    return std::nullopt;
  }
}

// The outputs are added to `outputs`.
void noteFiles(const CLI::App& app, std::vector<NotedOutput>& outputs) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& word : option->results()) notePipe(word);
    if (marked(*option, kPickedMark)) continue;
    const std::optional<std::string> output = marked(*option, kOutputMark);
    std::vector<std::string> files = option->results();
    if (files.empty() && output && !option->get_default_str().empty()) files = {option->get_default_str()};
    for (const std::string& file : files) output ? noteNamedOutput(file) : noteInput(file);
    if (!output) continue;
    for (const std::string& file : files) outputs.push_back({file, *output});
  }
  for (const CLI::App* command : app.get_subcommands()) noteFiles(*command, outputs);
}

}  // namespace

void noteFiles(const CLI::App& app) {
  std::vector<NotedOutput> outputs;
  noteFiles(app, outputs);
  std::vector<std::string> files;
  for (const NotedOutput& output : outputs) files.push_back(output.file);
  keepStandardOutputFor(files);
  for (const NotedOutput& output : outputs)
    if (output.format != kAnyFormat) keepOtherFormats(output.file, output.format);
}

}  // namespace skel
