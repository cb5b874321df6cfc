#include "libskel/core/standard_output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

namespace skel {
namespace {

// The standard output once what is printed goes elsewhere; /dev/stdout leads there, too.
int kept = -1;
std::set<std::string>& names() {
  static std::set<std::string>& all = *new std::set<std::string>;
  return all;
}

bool isStandardOutput(const std::string& path, int standard_output) {
  struct stat there, standard;
  return ::stat(path.c_str(), &there) == 0 && ::fstat(standard_output, &standard) == 0 &&
         there.st_dev == standard.st_dev && there.st_ino == standard.st_ino;
}

}  // namespace

void keepStandardOutputFor(const std::vector<std::string>& outputs) {
  if (isStandardOutput("/dev/null", STDOUT_FILENO)) return;
  for (const std::string& output : outputs)
    if (isStandardOutput(output, STDOUT_FILENO)) names().insert(output);
  if (names().empty()) return;
  std::fflush(stdout);
  kept = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (kept >= 0) ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

int standardOutputNamed(const std::string& path) {
  const int standard_output = kept < 0 ? STDOUT_FILENO : kept;
  return names().contains(path) || isStandardOutput(path, standard_output) ? standard_output : -1;
}

bool isFileToReplace(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown) && standardOutputNamed(path) < 0;
}

}  // namespace skel
