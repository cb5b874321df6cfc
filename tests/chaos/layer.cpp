// Stands before the C library (LD_PRELOAD) and spoils one call of a program:
//   SKEL_CHAOS="fail N"      the N-th call that changes files fails
//   SKEL_CHAOS="full N"      and so do all writes after it: the disk is full
//   SKEL_CHAOS="signal N S"  signal S arrives just before it
//   SKEL_CHAOS="kill N K"    the program is killed there, after K sixteenths of the bytes if it is a write
//   SKEL_CHAOS="alloc N B"   the N-th allocation of B bytes or more fails
// SKEL_CHAOS_COUNT names a file that gets the number of calls (of allocations, with "alloc") when the program
// ends.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum class Mode { kNone, kFail, kFull, kSignal, kKill, kAlloc };
struct Plan {
  Mode mode = Mode::kNone;
  long at = 0, argument = 0;
};

Plan readPlan() {
  Plan plan;
  const char* text = std::getenv("SKEL_CHAOS");
  char mode[16] = "";
  if (!text || std::sscanf(text, "%15s %ld %ld", mode, &plan.at, &plan.argument) < 2) return plan;
  constexpr const char* kNames[] = {"", "fail", "full", "signal", "kill", "alloc"};
  for (int k = 1; k < 6; ++k)
    if (std::strcmp(mode, kNames[k]) == 0) plan.mode = static_cast<Mode>(k);
  return plan;
}

Plan plan;
std::atomic<long> calls{0}, allocations{0};
std::atomic<bool> full{false};

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
#define NEXT(function) next(&::function, #function)

// Whether the call that is about to be made is to fail. `before_death` does what a killed call had done by
// then.
template <class BeforeDeath>
bool spoiled(const BeforeDeath& before_death) {
  if (plan.mode == Mode::kAlloc) return false;
  if (++calls != plan.at) return false;
  switch (plan.mode) {
    case Mode::kFull:
      full = true;
      return true;
    case Mode::kFail:
      return true;
    case Mode::kSignal:
      ::kill(::getpid(), static_cast<int>(plan.argument));
      return false;
    case Mode::kKill:
      before_death();
      ::kill(::getpid(), SIGKILL);
      return false;
    default:
      return false;
  }
}
bool spoiled() {
  return spoiled([] {});
}
int failed(int reason) {
  errno = reason;
  return -1;
}

bool isFile(int fd) {
  struct stat status;
  return fd > 2 && ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

bool refused(std::size_t bytes) {
  return plan.mode == Mode::kAlloc && bytes >= static_cast<std::size_t>(plan.argument) &&
         ++allocations == plan.at;
}

struct Session {
  Session() { plan = readPlan(); }
  ~Session() {
    const char* path = std::getenv("SKEL_CHAOS_COUNT");
    const Mode mode = plan.mode;
    plan = {};
    std::FILE* file = path ? std::fopen(path, "w") : nullptr;
    if (!file) return;
    std::fprintf(file, "%ld\n", mode == Mode::kAlloc ? allocations.load() : calls.load());
    std::fclose(file);
  }
} session;

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_ACCMODE) != O_RDONLY && spoiled()) return failed(ENOSPC);
  static auto* const real = NEXT(open);
  return real(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  return ::open(path, flags, mode);
}
ssize_t write(int fd, const void* bytes, size_t count) {
  static auto* const real = NEXT(write);
  if (!isFile(fd)) return real(fd, bytes, count);
  const auto part = [&] { (void)!real(fd, bytes, count * static_cast<size_t>(plan.argument) / 16); };
  if (spoiled(part) || full) return failed(ENOSPC);
  return real(fd, bytes, count);
}
int fsync(int fd) {
  static auto* const real = NEXT(fsync);
  return spoiled() ? failed(EIO) : real(fd);
}
int rename(const char* from, const char* to) {
  static auto* const real = NEXT(rename);
  return spoiled() ? failed(EIO) : real(from, to);
}
int mkdir(const char* path, mode_t mode) {
  static auto* const real = NEXT(mkdir);
  return spoiled() ? failed(ENOSPC) : real(path, mode);
}

void* malloc(size_t bytes) {
  if (!refused(bytes)) return __libc_malloc(bytes);
  errno = ENOMEM;
  return nullptr;
}
void* calloc(size_t count, size_t each) {
  if (!refused(count * each)) return __libc_calloc(count, each);
  errno = ENOMEM;
  return nullptr;
}
void* realloc(void* block, size_t bytes) {
  if (!refused(bytes)) return __libc_realloc(block, bytes);
  errno = ENOMEM;
  return nullptr;
}
int posix_memalign(void** block, size_t alignment, size_t bytes) {
  void* made = refused(bytes) ? nullptr : __libc_memalign(alignment, bytes);
  if (!made) return ENOMEM;
  *block = made;
  return 0;
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  return refused(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  return refused(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}

}  // extern "C"
