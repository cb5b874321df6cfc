#include "libskel/core/temporary_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <list>
#include <utility>

namespace skel {
namespace {

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM};

// What the handler sees. More writers at once than there are slots are written, but not swept up.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<int> fd{-1};
  const char* path = nullptr;
};
constexpr int kSlots = 1100;  // --jobs goes to 1024
Slot slots[kSlots];

std::atomic<const char*> last_words{nullptr};
std::atomic<bool> dying{false};
std::atomic<int> making{0};

[[noreturn]] void waitForTheEnd() {
  for (;;) ::pause();
}

// While it lives, this thread makes a file and enters it, or takes it out: no signal comes here, and the
// handler, in another thread, waits for it. Once the handler is at work, no file is made any more.
class Making {
 public:
  Making() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kSignals) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
    ++making;
    if (dying) {
      --making;
      waitForTheEnd();
    }
  }
  ~Making() {
    --making;
    const int reason = errno;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = reason;
  }

 private:
  sigset_t before_;
};

bool isNamed(int fd, const char* path) {
  struct stat opened, named;
  return ::fstat(fd, &opened) == 0 && ::lstat(path, &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

// Calls the system alone, as a handler must.
void onSignal(int signal) {
  if (dying.exchange(true)) waitForTheEnd();
  const timespec moment{0, 1'000'000};
  while (making > 0) ::nanosleep(&moment, nullptr);
  for (Slot& slot : slots) {
    const int fd = slot.fd;
    // A file that another process has locked is that one's.
    if (fd >= 0 && ::flock(fd, LOCK_EX | LOCK_NB) == 0 && isNamed(fd, slot.path)) ::unlink(slot.path);
  }
  if (const char* words = last_words; words && signal == SIGINT)
    (void)!::write(STDERR_FILENO, words, std::strlen(words));
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  ::sigaction(signal, &usual, nullptr);
  ::raise(signal);
  sigset_t this_one;
  sigemptyset(&this_one);
  sigaddset(&this_one, signal);
  pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
}

int enter(int fd, const char* path) {
  for (int i = 0; i < kSlots; ++i) {
    if (slots[i].taken.exchange(true)) continue;
    slots[i].path = path;
    slots[i].fd = fd;
    return i;
  }
  return -1;
}

void leave(int slot) {
  if (slot < 0) return;
  const Making section;
  slots[slot].fd = -1;
  slots[slot].taken = false;
}

}  // namespace

bool writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

TemporaryFile::TemporaryFile(std::string target) : target_(std::move(target)), path_(target_ + ".skel-tmp") {
  for (;;) {
    bool made = false;
    {
      const Making section;
      constexpr int kFlags = O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
      fd_ = ::open(path_.c_str(), kFlags | O_CREAT | O_EXCL, 0666);
      made = fd_ >= 0;
      if (!made && errno == EEXIST) {
        fd_ = ::open(path_.c_str(), kFlags);
        if (fd_ < 0 && errno == ENOENT) continue;  // gone in between
      }
      if (fd_ >= 0) slot_ = enter(fd_, path_.c_str());
    }
    if (fd_ < 0) return;
    while (::flock(fd_, LOCK_EX) != 0 && errno == EINTR) {
    }
    // Whoever held the lock has renamed the file by now, unless it was killed.
    const bool still_there = isNamed(fd_, path_.c_str());
    if (made && still_there) return;
    if (still_there) ::unlink(path_.c_str());
    leave(slot_);
    ::close(fd_);
  }
}

TemporaryFile::~TemporaryFile() {
  if (fd_ < 0) return;
  const int reason = errno;
  if (!target_.empty()) ::unlink(path_.c_str());
  leave(slot_);
  ::close(fd_);
  errno = reason;
}

bool TemporaryFile::flush() { return ::fsync(fd_) == 0 || errno == EINVAL; }

bool TemporaryFile::becomeTarget() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) {
    if (dying) waitForTheEnd();
    return false;
  }
  target_.clear();
  return true;
}

void sayOnInterrupt(const std::string& text) {
  static std::list<std::string> texts;  // the handler may be at any of them
  last_words = texts.emplace_back(text).c_str();
}

void removeTemporaryFilesOnSignals() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  for (const int signal : kSignals) {
    struct sigaction now;
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL)
      ::sigaction(signal, &action, nullptr);
  }
  // A write beyond the limit of a file's size fails, and says so.
  ::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace skel
