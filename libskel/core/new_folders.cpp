#include "libskel/core/new_folders.h"

#include <filesystem>

namespace skel {
namespace fs = std::filesystem;

NewFolders::NewFolders(const std::string& output) {
  std::error_code unknown;
  for (fs::path dir = fs::path(output).parent_path(); !dir.empty() && !fs::exists(dir, unknown);
       dir = dir.parent_path())
    missing_.push_back(dir.string());
}

NewFolders::~NewFolders() {
  std::error_code unknown, holds_something;
  for (const std::string& dir : missing_)
    if (fs::is_directory(dir, unknown)) fs::remove(dir, holds_something);
}

}  // namespace skel
