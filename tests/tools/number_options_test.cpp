// Every number option of every command of every tool, by what --help names.
#include <regex>
#include <sstream>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;

namespace {

const std::vector<std::string> kTools = {"skel-animate", "skel-infer", "skel-label", "skel-style",
                                         "skel-train"};

std::string helpOf(const std::string& command) { return runTool(command + " --help").out; }

// The tool itself, and its commands.
std::vector<std::string> commandsOf(const std::string& tool) {
  std::vector<std::string> commands = {tool};
  std::istringstream help(helpOf(tool));
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line == "Subcommands:") listed = true;
    std::smatch name;
    if (listed && std::regex_search(line, name, std::regex("^  ([a-z]+)")))
      commands.push_back(tool + " " + name.str(1));
  }
  return commands;
}

std::vector<std::string> numberOptionsOf(const std::string& command) {
  std::vector<std::string> options;
  std::istringstream help(helpOf(command));
  for (std::string line; std::getline(help, line);) {
    std::smatch option;
    if (std::regex_search(line, option, std::regex("(--[a-z-]+) (?:FLOAT|INT|UINT)")))
      options.push_back(option.str(1));
  }
  return options;
}

}  // namespace

TEST_CASE("no number option of any tool takes what is no number, infinite or absurd") {
  int seen = 0;
  for (const std::string& tool : kTools)
    for (const std::string& command : commandsOf(tool))
      for (const std::string& option : numberOptionsOf(command)) {
        ++seen;
        for (const std::string value : {"nan", "inf", "-inf", "1e300"}) {
          const ToolRun run = runTool(command + " " + option + "=" + value);
          CAPTURE(command, option, value, run.err);
          CHECK(run.exit_code == 1);
          CHECK(run.err.find(option) != std::string::npos);
          CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        }
      }
  CHECK(seen > 80);
}

TEST_CASE("a height of 1e-300, which gave a model of NaNs, and a mesh spacing of nan are refused") {
  for (const std::string option : {"--height 1e-300", "--mesh-spacing nan", "--mesh-spacing 1e-300"}) {
    const ToolRun run = runTool("skel-infer none.png " + option);
    CAPTURE(option, run.err);
    CHECK(run.exit_code == 1);
    CHECK(run.err.find(option.substr(0, option.find(' '))) != std::string::npos);
  }
}
