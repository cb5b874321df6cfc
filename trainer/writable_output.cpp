#include "trainer/writable_output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"

namespace skel {
namespace fs = std::filesystem;

void ensureWritableFile(const std::string& file) {
  std::error_code unknown;
  const fs::file_type type = fs::status(file, unknown).type();
  if (type == fs::file_type::directory) throw OutputError(file, "cannot be replaced: it is a folder");
  // What is no file is written as it comes.
  if (type == fs::file_type::regular || type == fs::file_type::not_found) ensureWritableFolderOf(file);
  if (type != fs::file_type::not_found && ::access(file.c_str(), W_OK) != 0)
    throw OutputError(file, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace skel
