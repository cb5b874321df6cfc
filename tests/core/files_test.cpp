#include "libskel/core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/core/temporary_file.h"
#include "tests/support/catch.h"
#include "tests/support/locked_folder.h"
#include "tests/support/temp_dir.h"

using namespace skel;

TEST_CASE("a file comes back as it was written, in folders made for it") {
  const TempDir dir;
  const std::string path = dir.file("a/b/c.bin"), bytes("one\0two\n", 8);
  writeFile(path, bytes);
  CHECK(readFile(path) == bytes);
  writeFile(path, "");
  CHECK(readFile(path).empty());
}

TEST_CASE("writing leaves no temporary file behind, also when it fails") {
  const TempDir dir;
  writeFile(dir.file("x"), "1");
  std::filesystem::create_directories(dir.file("taken/inside"));
  CHECK_THROWS_AS(writeFile(dir.file("taken"), "2"), OutputError);
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(dir.path())) ++count;
  CHECK(count == 2);
}

TEST_CASE("reading says what is wrong with which file") {
  const TempDir dir;
  const std::string missing = dir.file("missing");
  CHECK_THROWS_WITH(readFile(missing), missing + ": cannot be read: No such file or directory");
  CHECK_THROWS_WITH(readFile(dir.path()), dir.path() + ": is a folder, not a file");
  CHECK_THROWS_WITH(readFile("/dev/zero"), "/dev/zero: is a device, not a file");
}

TEST_CASE("a file where a folder is wanted is refused") {
  const TempDir dir;
  writeFile(dir.file("x"), "1");
  CHECK_THROWS_AS(ensureWritableFolder(dir.file("x")), OutputError);
  CHECK_THROWS_AS(writeFile(dir.file("x/y"), "1"), OutputError);
  ensureWritableFolder(dir.file("new/one"));
  CHECK(std::filesystem::is_directory(dir.file("new/one")));
}

TEST_CASE("what a killed writer has left is taken over") {
  const TempDir dir;
  std::ofstream(dir.file("x.skel-tmp")) << std::string(100'000, 'z');
  writeFile(dir.file("x"), "new");
  CHECK(readFile(dir.file("x")) == "new");
  CHECK_FALSE(std::filesystem::exists(dir.file("x.skel-tmp")));
}

TEST_CASE("several writers of one file take turns, and readers see it whole") {
  const TempDir dir;
  const std::string path = dir.file("x");
  const auto isWhole = [](const std::string& bytes) {
    return bytes.size() >= 1000 && bytes == std::string(bytes.size(), bytes.front());
  };
  writeFile(path, std::string(1000, 'a'));
  std::atomic<int> torn = 0;
  std::vector<std::thread> writers;
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([&, w] {
      for (int i = 0; i < 25; ++i) {
        writeFile(path, std::string(static_cast<size_t>(1000 + 50'000 * w), static_cast<char>('a' + w)));
        if (!isWhole(readFile(path))) ++torn;
      }
    });
  for (std::thread& writer : writers) writer.join();
  CHECK(torn == 0);
  CHECK_FALSE(std::filesystem::exists(path + ".skel-tmp"));
}

TEST_CASE("files below a folder: sorted, at any depth, with links that lead nowhere") {
  namespace fs = std::filesystem;
  const TempDir dir;
  writeFile(dir.file("b/c"), "");
  writeFile(dir.file("b.x"), "");
  writeFile(dir.file("a"), "");
  fs::create_directories(dir.file("empty"));
  fs::create_directory_symlink(dir.path(), dir.file("round and round"));
  fs::create_symlink("nowhere", dir.file("dangling"));
  fs::create_symlink("loop", dir.file("loop"));
  CHECK(filesBelow(dir.path()) == std::vector<std::string>{dir.file("a"), dir.file("b.x"), dir.file("b/c"),
                                                           dir.file("dangling"), dir.file("loop")});
  CHECK_THROWS_WITH(readFile(dir.file("loop")),
                    dir.file("loop") + ": cannot be read: Too many levels of symbolic links");
  CHECK_THROWS_WITH(filesBelow(dir.file("nowhere")), dir.file("nowhere") + ": does not exist");
  CHECK_THROWS_WITH(filesBelow(dir.file("a")), dir.file("a") + ": is not a folder");
}

TEST_CASE("a folder that may not be read is named") {
  const TempDir dir;
  writeFile(dir.file("a/locked/x"), "");
  const LockedFolder locked(dir, "a/locked");
  CHECK_THROWS_WITH(filesBelow(dir.path()), dir.file("a/locked") + ": cannot be read: Permission denied");
  CHECK_THROWS_WITH(filesBelow(dir.file("a/locked/x")),
                    dir.file("a/locked/x") + ": cannot be read: Permission denied");
}

TEST_CASE("a path as seen from another file's folder") {
  CHECK(pathSeenFrom("out/a.json", "pictures/x.png") == "../pictures/x.png");
  CHECK(pathSeenFrom("not/there/yet/a.json", "x.png") == "../../../x.png");
  CHECK(pathSeenFrom("a.json", "x.png") == "x.png");
  CHECK(pathSeenFrom("/tmp/a/b.json", "/tmp/a/c/x.png") == "c/x.png");
}

TEST_CASE("a device is written into and stays a device") {
  struct stat before, after;
  REQUIRE(stat("/dev/null", &before) == 0);
  writeFile("/dev/null", "gone");
  REQUIRE(stat("/dev/null", &after) == 0);
  CHECK(S_ISCHR(after.st_mode));
  CHECK(after.st_ino == before.st_ino);
  CHECK_THROWS_WITH(writeFile("/dev/full", "x"), "/dev/full: cannot be written: No space left on device");
}

TEST_CASE("a FIFO is written into, and read twice gives the same bytes") {
  const TempDir dir;
  const std::string path = dir.file("pipe"), bytes(200'000, 'x');
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  std::thread writer([&] { writeFile(path, bytes); });
  CHECK(readFile(path) == bytes);
  writer.join();
  CHECK(readFile(path) == bytes);
  CHECK(std::filesystem::is_fifo(path));
}

TEST_CASE("writing through links leaves the links and replaces what they lead to") {
  namespace fs = std::filesystem;
  const TempDir dir;
  writeFile(dir.file("there/file"), "old");
  fs::create_directories(dir.file("here"));
  fs::create_symlink("../there/file", dir.file("here/link"));
  fs::create_symlink("link", dir.file("here/second"));
  fs::create_symlink("../there/new", dir.file("here/dangling"));
  fs::create_symlink("loop", dir.file("here/loop"));
  writeFile(dir.file("here/second"), "new");
  CHECK(fs::is_symlink(dir.file("here/second")));
  CHECK(fs::is_symlink(dir.file("here/link")));
  CHECK(readFile(dir.file("there/file")) == "new");
  writeFile(dir.file("here/dangling"), "made");
  CHECK(fs::is_symlink(dir.file("here/dangling")));
  CHECK(readFile(dir.file("there/new")) == "made");
  CHECK_THROWS_AS(writeFile(dir.file("here/loop"), "x"), OutputError);
  CHECK(filesBelow(dir.path()).size() == 6);  // no temporary file
}

TEST_CASE("a file that is replaced keeps its mode") {
  const TempDir dir;
  for (const mode_t mode : {0600u, 0640u, 0755u, 0666u}) {
    const std::string path = dir.file(std::to_string(mode));
    writeFile(path, "old");
    REQUIRE(chmod(path.c_str(), mode) == 0);
    writeFile(path, "new");
    struct stat status;
    REQUIRE(stat(path.c_str(), &status) == 0);
    CHECK((status.st_mode & 07777) == mode);
  }
}

TEST_CASE("a file that its owner has protected is not replaced") {
  const TempDir dir;
  writeFile(dir.file("a/kept"), "kept");
  REQUIRE(chmod(dir.file("a/kept").c_str(), 0444) == 0);
  REQUIRE(chmod(dir.file("a").c_str(), 0777) == 0);
  writeFile(dir.file("locked/x"), "");
  const LockedFolder somebody_else(dir, "locked");
  CHECK_THROWS_WITH(writeFile(dir.file("a/kept"), "lost"),
                    dir.file("a/kept") + ": cannot be written: Permission denied");
  CHECK(readFile(dir.file("a/kept")) == "kept");
}

// While it lives, signals do what they do in a tool: without Catch's handlers.
struct UsualSignals {
  UsualSignals() {
    for (const int signal : kAll) before.push_back(std::signal(signal, SIG_DFL));
  }
  ~UsualSignals() {
    for (std::size_t i = 0; i < before.size(); ++i) std::signal(kAll[i], before[i]);
  }
  static constexpr int kAll[] = {SIGHUP, SIGINT, SIGTERM};
  std::vector<void (*)(int)> before;
};

TEST_CASE("SIGINT, SIGTERM and SIGHUP take temporary files with them and kill") {
  const UsualSignals usual;
  for (const int signal : UsualSignals::kAll)
    for (int round = 0; round < 10; ++round) {
      const TempDir dir;
      const pid_t child = fork();
      if (child == 0) {
        removeTemporaryFilesOnSignals();
        const std::string bytes(3'000'000, 'x');
        std::vector<std::thread> writers;
        for (int w = 0; w < 3; ++w)
          writers.emplace_back([&, w] {
            for (;;) writeFile(dir.file(std::to_string(w)), bytes);
          });
        for (std::thread& writer : writers) writer.join();
      }
      while (!std::filesystem::exists(dir.file("0"))) usleep(1000);
      usleep(static_cast<useconds_t>(1000 * round));
      REQUIRE(kill(child, signal) == 0);
      int status = 0;
      REQUIRE(waitpid(child, &status, 0) == child);
      CHECK(WIFSIGNALED(status));
      CHECK(WTERMSIG(status) == signal);
      for (const std::string& file : filesBelow(dir.path())) {
        CAPTURE(file);
        CHECK_FALSE(file.ends_with(".skel-tmp"));
        CHECK(std::filesystem::file_size(file) == 3'000'000);
      }
    }
}

// A process that waits for `path`, in its own thread or in another one, dies by SIGTERM and leaves the
// other's file.
void dieWaiting(bool in_own_thread) {
  const UsualSignals usual;
  const TempDir dir;
  const std::string path = dir.file("x");
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    removeTemporaryFilesOnSignals();
    char go;
    while (read(ends[0], &go, 1) != 1) {
    }
    const auto wait = [&] { writeFile(path, "theirs"); };
    std::thread waiting;
    if (in_own_thread)
      wait();
    else
      waiting = std::thread(wait);
    for (;;) pause();
  }
  TemporaryFile ours(path);
  REQUIRE(ours.fd() >= 0);
  REQUIRE(write(ends[1], "!", 1) == 1);
  usleep(50'000);
  REQUIRE(kill(child, SIGTERM) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(std::filesystem::exists(path + ".skel-tmp"));
  CHECK(ours.becomeTarget());
  CHECK(std::filesystem::exists(path));
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("a signal leaves the temporary file that another process is writing") {
  dieWaiting(false);
  // ThreadSanitizer holds a signal back until its thread calls what it knows, and flock() is not among that:
  // a thread that waits there would never hear of it.
#ifndef __SANITIZE_THREAD__
  dieWaiting(true);
#endif
}

TEST_CASE("a locked folder makes others wait") {
  const TempDir dir;
  const std::string path = dir.file("count");
  writeFile(path, "0");
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 25; ++i) {
        const FolderLock lock(dir.path());
        writeFile(path, std::to_string(std::stoi(readFile(path)) + 1));
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(readFile(path) == "100");
  CHECK_THROWS_AS(FolderLock(dir.file("nowhere")), OutputError);
}

TEST_CASE("a pipe as seen from another file keeps its own path") {
  const TempDir dir;
  REQUIRE(mkfifo(dir.file("pipe").c_str(), 0600) == 0);
  CHECK(pathSeenFrom(dir.file("out/a.json"), dir.file("pipe")) == dir.file("pipe"));
}
