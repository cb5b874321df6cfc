// Runs one of the tools as a user would.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temp_dir.h"

namespace skel {

struct ToolRun {
  int exit_code = -1;  // 128 + signal if it was killed by one
  std::string out, err;
};

// Where this program lies, and the tools.
inline std::string binFolder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

// `command` is a line for the shell, which finds the tools beside the tests by their names.
inline ToolRun runTool(const std::string& command) {
  const TempDir dir;
  const auto slurp = [&](const char* name) {
    std::ifstream file(dir.file(name));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const int status = std::system(("PATH='" + binFolder() + "':$PATH; ( " + command + " ) >'" +
                                  dir.file("out") + "' 2>'" + dir.file("err") + "'")
                                     .c_str());
  ToolRun run;
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = slurp("out");
  run.err = slurp("err");
  return run;
}

}  // namespace skel
