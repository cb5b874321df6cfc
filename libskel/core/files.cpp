#include "libskel/core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "libskel/core/error.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string reason() { return std::strerror(errno); }

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

void makeFolder(const fs::path& dir, const std::string& path) {
  std::error_code failure;
  if (!dir.empty()) fs::create_directories(dir, failure);
  if (failure) throw OutputError(path, "cannot make its folder: " + failure.message());
}

}  // namespace

std::string readFile(const std::string& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) throw InputError(path, "cannot be read: " + reason());
  if (S_ISDIR(status.st_mode)) throw InputError(path, "is a folder, not a file");
  // /dev/zero never ends.
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) throw InputError(path, "is a device, not a file");
  Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0) throw InputError(path, "cannot be read: " + reason());
  std::string bytes;
  bytes.reserve(static_cast<size_t>(status.st_size));
  char block[65536];
  for (;;) {
    const ssize_t count = ::read(file.fd, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(path, "cannot be read: " + reason());
    if (count == 0) return bytes;
    bytes.append(block, static_cast<size_t>(count));
  }
}

void writeFile(const std::string& path, std::string_view bytes) {
  makeFolder(fs::path(path).parent_path(), path);
  static std::atomic<unsigned> counter{0};
  const std::string temporary =
      path + ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1));
  const auto fail = [&](const char* what) {
    const std::string why = reason();
    ::unlink(temporary.c_str());
    throw OutputError(path, std::string(what) + ": " + why);
  };
  {
    Descriptor file{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
    if (file.fd < 0) throw OutputError(path, "cannot be written: " + reason());
    while (!bytes.empty()) {
      const ssize_t count = ::write(file.fd, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("cannot be written");
      bytes.remove_prefix(static_cast<size_t>(count));
    }
    if (::fsync(file.fd) != 0 && errno != EINVAL) fail("cannot be written");
  }
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot be replaced");
}

void ensureWritableFolder(const std::string& dir) {
  std::error_code failure;
  if (fs::exists(dir, failure) && !fs::is_directory(dir))
    throw OutputError(dir, "is not a folder; name another with -o");
  fs::create_directories(dir, failure);
  if (failure) throw OutputError(dir, "cannot be made: " + failure.message());
  if (::access(dir.c_str(), W_OK | X_OK) != 0) throw OutputError(dir, "cannot be written to: " + reason());
}

}  // namespace skel
