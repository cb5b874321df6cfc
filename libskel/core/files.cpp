#include "libskel/core/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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

// Opens the temporary file for one writer at a time.
int openLocked(const std::string& temporary) {
  for (;;) {
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd < 0) return fd;
    while (::flock(fd, LOCK_EX) != 0 && errno == EINTR) {
    }
    // Whoever held the lock has renamed the file by now, unless it was killed.
    struct stat locked, named;
    if (::fstat(fd, &locked) == 0 && ::stat(temporary.c_str(), &named) == 0 &&
        locked.st_ino == named.st_ino && locked.st_dev == named.st_dev)
      return fd;
    ::close(fd);
  }
}

void addFilesBelow(const fs::path& dir, std::vector<std::string>& files) {
  std::error_code failure;
  fs::directory_iterator entry(dir, failure);
  for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
    std::error_code unknown;
    const fs::file_type type = entry->symlink_status(unknown).type();
    if (type == fs::file_type::directory) {
      addFilesBelow(entry->path(), files);
    } else {
      const fs::file_type target = entry->status(unknown).type();
      if (target == fs::file_type::regular || target == fs::file_type::not_found ||
          target == fs::file_type::none)
        files.push_back(entry->path().string());
    }
  }
  if (failure) throw InputError(dir.string(), "cannot be read: " + failure.message());
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
  const std::string temporary = path + ".skel-tmp";
  const auto fail = [&](const char* what) {
    const std::string why = reason();
    ::unlink(temporary.c_str());
    throw OutputError(path, std::string(what) + ": " + why);
  };
  Descriptor file{openLocked(temporary)};
  if (file.fd < 0) throw OutputError(path, "cannot be written: " + reason());
  if (::ftruncate(file.fd, 0) != 0) fail("cannot be written");
  while (!bytes.empty()) {
    const ssize_t count = ::write(file.fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot be written");
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  if (::fsync(file.fd) != 0 && errno != EINVAL) fail("cannot be written");
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot be replaced");
}

std::vector<std::string> filesBelow(const std::string& dir) {
  std::error_code failure;
  const fs::file_type type = fs::status(dir, failure).type();
  if (type == fs::file_type::none) throw InputError(dir, "cannot be read: " + failure.message());
  if (type != fs::file_type::directory) throw InputError(dir, "is not a folder");
  std::vector<std::string> files;
  addFilesBelow(dir, files);
  std::sort(files.begin(), files.end());
  return files;
}

std::string pathSeenFrom(const std::string& other, const std::string& file) {
  // Absolute first: fs::proximate() finds no way from a relative folder that is not there yet.
  return fs::proximate(fs::absolute(file), fs::absolute(other).parent_path()).generic_string();
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
