// What the mains of all tools share: exit codes and one line for the user. The only header of libskel that
// sees CLI11; no room includes it.
#pragma once

#include <CLI/CLI.hpp>
#include <clocale>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "libskel/core/error.h"

namespace skel {

// Adds a subcommand; when it is given, `chosen` becomes what it does.
template <class Options>
void addCommand(CLI::App& app, std::function<ExitCode()>& chosen, const std::string& name,
                const std::string& help, void (*bind)(CLI::App&, Options&), ExitCode (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, help);
  bind(*command, *options);
  command->callback([=, &chosen] { chosen = [=] { return run(*options); }; });
}

// Parses argv into `app`, then calls run(), which returns the exit code. CLI11's own codes become 1 (wrong
// usage). SKEL_VERSION is the project's, given to every tool (cmake/SkelBuild.cmake).
inline int runTool(CLI::App& app, int argc, char** argv, const std::function<ExitCode()>& run) {
  std::setlocale(LC_ALL, "C");
  app.set_version_flag("--version", app.get_name() + " " SKEL_VERSION, "Print the version and exit");
  const auto say = [&](const std::exception& error, ExitCode code) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return static_cast<int>(code);
  };
  try {
    app.parse(argc, argv);
    return static_cast<int>(run());
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::Error& error) {
    return say(error, ExitCode::kUsage);
  } catch (const Error& error) {
    return say(error, error.exitCode());
  } catch (const std::filesystem::filesystem_error& error) {
    return say(InputError(error.path1().string(), "cannot be looked at: " + error.code().message()),
               ExitCode::kInput);
  } catch (const std::bad_alloc& error) {
    return say(error, ExitCode::kUnavailable);
  }
}

}  // namespace skel
