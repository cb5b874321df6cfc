#include "libskel/core/file_names.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/tool_command.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

using namespace skel;
namespace fs = std::filesystem;

TEST_CASE("a clip named ../../x becomes a name in the folder, and a good name stays") {
  CHECK(safeFileName("walk") == "walk");
  CHECK(safeFileName("two words.v2") == "two words.v2");
  CHECK(safeFileName("gehen-\xC3\xA4") == "gehen-\xC3\xA4");
  CHECK(safeFileName("../../x") == "_._.._x");
  CHECK(safeFileName("/etc/passwd") == "_etc_passwd");
  CHECK(safeFileName("..") == "_.");
  CHECK(safeFileName("a\\b\nc:d") == "a_b_c_d");
  CHECK(safeFileName(std::string("a\0b", 3)) == "a_b");
  CHECK(safeFileName("") == "_");
  CHECK(safeFileName(" x ") == "_x_");
  CHECK(safeFileName("-rf") == "_rf");
  const std::string long_name = safeFileName(std::string(119, 'x') + "\xC3\xA4" + "end");
  CHECK(long_name == std::string(119, 'x'));
}

TEST_CASE("what a file names lies in its folder, or is refused") {
  const TempDir dir;
  writeFile(dir.file("set/pictures/a.png"), "");
  writeFile(dir.file("outside/b.png"), "");
  fs::create_directory_symlink(dir.file("outside"), dir.file("set/link"));
  fs::create_symlink(dir.file("outside/b.png"), dir.file("set/b.png"));
  const std::string set = dir.file("set"), list = dir.file("set/list.json");
  CHECK(pathInside(set, "pictures/a.png", list) == set + "/pictures/a.png");
  CHECK(pathInside(set, "pictures/../pictures/a.png", list) == set + "/pictures/../pictures/a.png");
  CHECK(pathInside(set, "b.png", list) == set + "/b.png");
  CHECK(pathInside(set, "not/there/yet.png", list) == set + "/not/there/yet.png");
  CHECK(pathInside("", "a.png", list) == "./a.png");
  for (const std::string out :
       {"../outside/b.png", "pictures/../../outside/b.png", "link/b.png", "..", "pictures/..", "", "."})
    CHECK_THROWS_WITH(
        pathInside(set, out, list),
        list + ": names \"" + out + "\", which lies outside of its folder; move the files together");
  CHECK_THROWS_AS(pathInside(set, set + "/pictures/a.png", list), InputError);
  for (const char* in : {"/pictures/a.png", "/b.png", "/not/there/yet.png"}) CHECK(liesBelow(set, set + in));
  for (const char* out : {"/link/b.png", "/../outside/b.png", "/../setting.png"})
    CHECK_FALSE(liesBelow(set, set + out));
}

TEST_CASE("a name that begins with a zero byte does not lead out of its folder unseen") {
  const TempDir dir;
  using namespace std::string_literals;
  CHECK_THROWS_AS(pathInside(dir.path(), "\0../../../x"s, "list.json"), InputError);
}

TEST_CASE("a path as a word of the shell is in quotes where it needs them, and comes back as it was") {
  CHECK(shellWord("class/anna-2_b.png") == "class/anna-2_b.png");
  CHECK(shellWord("class/J\u00fcrgen.png") == "class/J\u00fcrgen.png");
  CHECK(shellWord("my hero.png") == "'my hero.png'");
  CHECK(shellWord("$(rm *).png") == "'$(rm *).png'");
  CHECK(shellWord("Eva's.png") == "'Eva'\\''s.png'");
  CHECK(shellWord("") == "''");
  CHECK(shellWord("a\x1b[2J'\n") == "$'a\\x1b[2J\\'\\x0a'");
  for (const std::string path : {"a b", "it's; `x` \"y\" \\ $HOME ~ & | <", "-n"})
    CHECK(runTool("printf %s " + shellWord(path)).out == path);
}

TEST_CASE("a tool that does not lie beside the running program is called by its name alone") {
  CHECK(toolCommand("skel-nowhere") == "skel-nowhere");
}
