// What the mains of all tools share: exit codes and one line for the user.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "libskel/core/error.h"

namespace skel {

// Adds a subcommand; when it is given, `chosen` becomes what it does. `example`: a command line, which stands
// below its help.
template <class Options>
void addCommand(CLI::App& app, std::function<ExitCode()>& chosen, const std::string& name,
                const std::string& help, void (*bind)(CLI::App&, Options&), ExitCode (*run)(const Options&),
                const std::string& example = "") {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, help);
  if (!example.empty()) command->footer("Example: " + example);
  bind(*command, *options);
  command->callback([=, &chosen] { chosen = [=] { return run(*options); }; });
}

// The project's.
std::string skelVersion();
// SHA-256 of the nets that are compiled in, each behind its name and a blank; empty: none are.
std::string netHashes();

// Parses argv into `app`, then calls run(), which returns the exit code. The one place where all that a tool
// may throw becomes one line and an exit code; CLI11's own codes become 1 (wrong usage).
int runTool(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& run);

}  // namespace skel
