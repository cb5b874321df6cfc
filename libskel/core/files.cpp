#include "libskel/core/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/standard_output.h"
#include "libskel/core/temporary_file.h"

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

// Where a chain of links ends, there or not.
std::string withoutLinks(const std::string& path) {
  fs::path target = path;
  std::error_code failure;
  for (int links = 0; fs::is_symlink(target, failure); ++links) {
    constexpr int kMostLinks = 40;  // as the system's
    if (links == kMostLinks) throw OutputError(path, "cannot be written: too many levels of symbolic links");
    const fs::path next = fs::read_symlink(target, failure);
    if (failure) throw OutputError(path, "cannot be written: " + failure.message());
    target = target.parent_path() / next;
  }
  return target.string();
}

void writeTo(int fd, std::string_view bytes, const std::string& path) {
  if (!writeAll(fd, bytes)) throw OutputError(path, "cannot be written: " + reason());
}

// What is no file, or is the standard output under another name (/dev/stdout), is written as it comes.
bool wroteDirectly(const std::string& path, const struct stat& there, std::string_view bytes) {
  if (const int standard_output = standardOutputNamed(path); standard_output >= 0) {
    std::fflush(stdout);
    writeTo(standard_output, bytes, path);
    return true;
  }
  if (S_ISREG(there.st_mode)) return false;
  if (S_ISFIFO(there.st_mode) && !mayOpenPipe(there))
    throw OutputError(path, "cannot be replaced: it is a pipe");
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY)};
  if (file.fd < 0) throw OutputError(path, "cannot be written: " + reason());
  writeTo(file.fd, bytes, path);
  return true;
}

void write(const std::string& path, std::string_view bytes) {
  struct stat there;
  const bool exists = ::stat(path.c_str(), &there) == 0;
  if (exists && S_ISDIR(there.st_mode)) throw OutputError(path, "cannot be replaced: it is a folder");
  if (exists && wroteDirectly(path, there, bytes)) return;
  const std::string target = withoutLinks(path);
  makeFolder(fs::path(target).parent_path(), path);
  // The folder's permission would be enough to replace it.
  if (exists && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
    throw OutputError(path, "cannot be written: " + reason());
  TemporaryFile file(target);
  if (file.fd() < 0) throw OutputError(path, "cannot be written: " + reason());
  if (exists) {
    // The owner first: a change of it takes special bits away. It is not ours to give unless we are root.
    if (there.st_uid != ::geteuid() || there.st_gid != ::getegid())
      (void)!::fchown(file.fd(), there.st_uid, there.st_gid);
    (void)::fchmod(file.fd(), there.st_mode & 07777);
  }
  writeTo(file.fd(), bytes, path);
  if (!file.flush()) throw OutputError(path, "cannot be written: " + reason());
  struct stat written;
  const bool known = ::fstat(file.fd(), &written) == 0;
  if (!file.becomeTarget()) throw OutputError(path, "cannot be replaced: " + reason());
  if (known) noteReplaced(exists ? &there : nullptr, written);
}

// A pipe gives its bytes once.
class Pipes {
 public:
  template <class Read>
  std::string bytesOf(const struct stat& pipe, const Read& read) {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = bytes_.try_emplace({pipe.st_dev, pipe.st_ino});
    if (is_new) known->second = read();
    return known->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<dev_t, ino_t>, std::string> bytes_;
};

std::string bytesIn(int fd, std::size_t expected, const std::string& path) {
  std::string bytes;
  bytes.reserve(expected);
  char block[65536];
  for (;;) {
    const ssize_t count = ::read(fd, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(path, "cannot be read: " + reason());
    if (count == 0) return bytes;
    bytes.append(block, static_cast<size_t>(count));
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
  const auto read = [&] {
    Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.fd < 0) throw InputError(path, "cannot be read: " + reason());
    return bytesIn(file.fd, static_cast<size_t>(status.st_size), path);
  };
  if (!S_ISREG(status.st_mode)) {
    if (!mayOpenPipe(status))
      throw InputError(path, "is a pipe, not a file; pipes are read where the command line names them");
    static Pipes pipes;
    return pipes.bytesOf(status, read);
  }
  noteInput(path);
  return read();
}

void writeFile(const std::string& path, std::string_view bytes) {
  noteOutput(path);
  write(path, bytes);
}

void replaceFile(const std::string& path, std::string_view bytes) { write(path, bytes); }

std::vector<std::string> filesBelow(const std::string& dir) {
  std::error_code failure;
  const fs::file_type type = fs::status(dir, failure).type();
  if (type == fs::file_type::none) throw InputError(dir, "cannot be read: " + failure.message());
  if (type == fs::file_type::not_found) throw InputError(dir, "does not exist");
  if (type != fs::file_type::directory) throw InputError(dir, "is not a folder");
  std::vector<std::string> files;
  addFilesBelow(dir, files);
  std::sort(files.begin(), files.end());
  return files;
}

std::string pathSeenFrom(const std::string& other, const std::string& file) {
  // Links such as /dev/stdin lead to what has no path.
  std::error_code failure;
  if (fs::exists(file, failure) && !fs::is_regular_file(file, failure) && !fs::is_directory(file, failure))
    return fs::absolute(file).generic_string();
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

void ensureWritableFolderOf(const std::string& file) {
  if (standardOutputNamed(file) >= 0) return;
  const fs::path folder = fs::path(file).parent_path();
  ensureWritableFolder(folder.empty() ? "." : folder.string());
}

FolderLock::FolderLock(const std::string& dir)
    : fd_(::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  int failed = fd_ < 0 ? -1 : 0;
  if (fd_ >= 0) {
    while ((failed = ::flock(fd_, LOCK_EX)) != 0 && errno == EINTR) {
    }
  }
  if (failed == 0) return;
  const std::string why = reason();
  if (fd_ >= 0) ::close(fd_);
  throw OutputError(dir, "cannot be locked: " + why);
}

FolderLock::~FolderLock() { ::close(fd_); }

}  // namespace skel
