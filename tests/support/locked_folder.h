// Folders that may not be read, also where the tests run as root, who may read everything.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/support/temp_dir.h"

namespace skel {

// While it lives, `name` below `dir` may not be read, and the process is no longer root.
class LockedFolder {
 public:
  LockedFolder(const TempDir& dir, const std::string& name) : path_(dir.file(name)) {
    namespace fs = std::filesystem;
    fs::permissions(dir.path(), static_cast<fs::perms>(0755));
    fs::permissions(path_, fs::perms::none);
    if (geteuid() == 0 && seteuid(kNobody) != 0) throw std::runtime_error("cannot become another user");
  }
  ~LockedFolder() {
    if (getuid() == 0) (void)!seteuid(0);
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
  }
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  std::string path_;
};

}  // namespace skel
