#include "libskel/core/tool_command.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "libskel/core/file_names.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

// "": nowhere.
fs::path onPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  std::error_code unknown;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path tool = fs::path(folder) / name; fs::is_regular_file(tool, unknown)) return tool;
  return {};
}

}  // namespace

std::string toolCommand(const std::string& name) {
  std::error_code failure;
  const fs::path tool = fs::read_symlink("/proc/self/exe", failure).parent_path() / name;
  if (failure || !fs::is_regular_file(tool, failure) || fs::equivalent(onPath(name), tool, failure))
    return name;
  const fs::path below = tool.lexically_relative(fs::current_path(failure));
  if (failure || below.empty() || *below.begin() == "..") return shellWord(tool.string());
  return shellWord(below.has_parent_path() ? below.string() : "./" + name);
}

}  // namespace skel
