#include "libskel/core/folder_listing.h"

#include <filesystem>

#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/locked_folder.h"
#include "tests/support/temp_dir.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a folder is listed in natural order, without what is hidden or not asked for") {
  const TempDir dir;
  for (const char* name : {"pose10.json", "pose9.json", ".hidden.json", "notes.txt"})
    writeFile(dir.file(name), "x");
  for (const char* name : {"b", "a.json", ".git"}) fs::create_directory(dir.file(name));
  const FolderListing poses =
      listFolder(dir.path() + "/", [](const std::string& name) { return name.ends_with(".json"); });
  CHECK(poses.folder == dir.path());
  CHECK(poses.folders == Names{"a.json", "b"});
  CHECK(poses.files == Names{"pose9.json", "pose10.json"});
  CHECK(poses.problem.empty());
  CHECK(listFolder(dir.path()).files == Names{"notes.txt", "pose9.json", "pose10.json"});
}

TEST_CASE("a folder that is not there or may not be read says so") {
  const TempDir dir;
  CHECK(listFolder(dir.file("gone")).problem == "cannot be read: No such file or directory");
  fs::create_directory(dir.file("locked"));
  const LockedFolder locked(dir, "locked");
  CHECK(listFolder(dir.file("locked")).problem == "cannot be read: Permission denied");
}

TEST_CASE("a dialog opens in the nearest folder that is there") {
  const TempDir dir;
  writeFile(dir.file("hero.glb"), "x");
  CHECK(folderAround(dir.file("hero.glb")) == dir.path());
  CHECK(folderAround(dir.file("out/films/hero.mp4")) == dir.path());
  CHECK(folderAround(dir.path() + "/") == dir.path());
  CHECK(folderAround("/no/such/folder") == "/");
  CHECK(folderAround("hero.glb") == fs::current_path().string());
}

TEST_CASE("what is chosen below the process's folder is named from there") {
  const std::string here = fs::current_path().string();
  CHECK(pathIn(here, "a.glb") == "a.glb");
  CHECK(pathIn(here + "/out", "a.glb") == "out/a.glb");
  CHECK(pathIn("/no/where", "a.glb") == "/no/where/a.glb");
  CHECK(pathIn(here, "/tmp/a.glb") == "/tmp/a.glb");
  CHECK(pathIn(here, "films/") == "films/");
}

TEST_CASE("a name that is typed gets the ending of what is saved, unless it has one of skel's own") {
  CHECK(withEnding("throw", ".clip.json") == "throw.clip.json");
  CHECK(withEnding("out/throw.v2", ".clip.json") == "out/throw.v2.clip.json");
  CHECK(withEnding("elkx", ".glb") == "elkx.glb");
  CHECK(withEnding("my.d/hello", ".pose.json") == "my.d/hello.pose.json");
  CHECK(withEnding("note.txt", ".pose.json") == "note.txt.pose.json");
  for (const char* name : {"throw.clip.json", "throw.json", "hello.pose.json", "ELK.GLB", "film/", ""})
    CHECK(withEnding(name, ".clip.json") == name);
}
