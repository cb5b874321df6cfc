#include "trainer/writable_output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/net_format.h"
#include "libskel/core/standard_output.h"

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

void ensureWritableNet(const std::string& file, std::string_view format) {
  ensureWritableFile(file);
  if (!isFileToReplace(file)) return;
  const LookAtOutputs look;
  const std::string there = netFormatOf(readFile(file));
  if (!there.empty() && there != format)
    throw OutputError(file, "is " + netFormatName(there) + ", and would be replaced by " +
                                netFormatName(format) + "; name another file by -o");
}

}  // namespace skel
