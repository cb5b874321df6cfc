#include "libskel/core/files.h"

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "libskel/core/error.h"
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
  CHECK_THROWS_WITH(filesBelow(dir.file("nowhere")), dir.file("nowhere") + ": is not a folder");
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
