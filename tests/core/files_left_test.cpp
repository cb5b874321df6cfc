#include "libskel/core/files_left.h"

#include <filesystem>

#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;
namespace fs = std::filesystem;

TEST_CASE(
    "a file has changed when it was written, removed or made since it was noted, however it was noted") {
  const TempDir dir;
  const std::string path = dir.file("pose.json");
  const bool was_there = GENERATE(true, false), is_read = GENERATE(true, false);
  const bool writes = GENERATE(true, false);
  CAPTURE(was_there, is_read, writes);
  if (was_there) writeFile(path, "before");
  FilesLeft left;
  CHECK_FALSE(left.hasChanged(path));
  is_read ? left.note(path) : left.noteUnread(path);
  CHECK_FALSE(left.hasChanged(dir.file("./pose.json")));
  if (writes)
    writeFile(path, "after, and longer");
  else
    was_there ? void(fs::remove(path)) : writeFile(path, "");
  CHECK(left.hasChanged(path));
  left.note(path);
  CHECK_FALSE(left.hasChanged(path));
}

TEST_CASE("of a file that is not read a change of the same length shows by its time") {
  const TempDir dir;
  const std::string path = dir.file("pose.json");
  writeFile(path, "before");
  FilesLeft left;
  left.noteUnread(path);
  writeFile(path, "behind");
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(1));
  CHECK(left.hasChanged(path));
}
