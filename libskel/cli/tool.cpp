#include "libskel/cli/tool.h"

#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/temporary_file.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

// What the command works on, for complaints about nothing in particular: its first file that is there, those
// without an option's name first.
std::string mainInput(const CLI::App& app) {
  std::string with_name;
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->count() > 0; })) {
    if (option->check_sname("o")) continue;
    for (const std::string& value : option->results()) {
      std::error_code unknown;
      if (!std::filesystem::exists(value, unknown)) continue;
      if (option->get_positional()) return value;
      if (with_name.empty()) with_name = value;
    }
  }
  for (const CLI::App* command : app.get_subcommands())
    if (const std::string input = mainInput(*command); !input.empty()) return input;
  return with_name;
}

// Throws UsageError where a command would leave out what stands before it, or another command, without a
// word. Options of the whole tool are a command's as well where it falls through to them.
void requireOneCommand(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) return;
  const CLI::App& command = *commands.front();
  if (commands.size() > 1)
    throw UsageError(command.get_name() + " and " + commands[1]->get_name() + " are two commands; give one");
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->count() > 0; }))
    if (option->get_positional() || !command.get_fallthrough())
      throw UsageError(command.get_name() + " takes no " + option->get_name() + " before it; see " +
                       app.get_name() + " " + command.get_name() + " --help");
}

// The example of the whole tool, which CLI11 hands down, is none of a command.
void keepExampleFromCommands(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    keepExampleFromCommands(*command);
    if (command->get_footer() == app.get_footer()) command->footer("");
  }
}

// Whether all that was printed has arrived; errno says why not.
bool printed() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
}

// Pictures come and go by the hundred: memory that is handed back to the system after each costs more than it
// saves, as every page of it must be cleared again.
void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that it takes
#endif
}

}  // namespace

std::string skelVersion() { return SKEL_VERSION; }
std::string netHashes() { return SKEL_NETS_SHA256; }

int runTool(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& run) {
  std::setlocale(LC_ALL, "C");
  keepFreedMemory();
  const std::string nets = netHashes();
  app.set_version_flag("--version",
                       app.get_name() + " " + skelVersion() + (nets.empty() ? "" : "\nnets, SHA-256:" + nets),
                       "Print the version, the hashes of the nets, and exit");
  requireNumberChecks(app);
  keepExampleFromCommands(app);
  const auto say = [&](const std::exception& error, ExitCode code) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), printable(error.what()).c_str());
    return static_cast<int>(code);
  };
  const auto finish = [&](int code) {
    if (printed() || code != 0) return code;
    return say(OutputError("standard output", std::string("cannot be written: ") + std::strerror(errno)),
               ExitCode::kOutput);
  };
  try {
    app.parse(argc, argv);
    requireOneCommand(app);
    guardInputs();
    removeTemporaryFilesOnSignals();
    noteFiles(app);
    return finish(static_cast<int>(run()));
  } catch (const CLI::Success& done) {
    return finish(app.exit(done));
  } catch (const CLI::Error& error) {
    return say(error, ExitCode::kUsage);
  } catch (...) {
    const Error error = caughtError(mainInput(app));
    return say(error, error.exitCode());
  }
}

}  // namespace skel
