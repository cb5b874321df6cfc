#include "libskel/core/files.h"

#include "libskel/core/error.h"
#include "tests/support/catch.h"
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
