// What is thrown where nobody expects it: one line that names the input, a code, and the others go on.
#include <algorithm>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/write_image.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

const std::string kDrawing = SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png";

// With at most so much address space. The sanitizers' own memory is more than any such limit.
#ifdef SKEL_SANITIZED
constexpr bool kLimitsWork = false;
#else
constexpr bool kLimitsWork = true;
#endif

ToolRun limited(const TempDir& dir, int mb, const std::string& command) {
  return runTool("cd '" + dir.path() + "' && ulimit -v " + std::to_string(mb * 1024) + " && " + command);
}

void writeDrawing(const std::string& path, int size) {
  Image image = blankImage(size, size);
  drawDisc(image, {size * .5, size * .3}, size * .12, {30, 30, 30});
  drawDisc(image, {size * .5, size * .6}, size * .2, {30, 30, 30});
  writeFile(path, encodePng(image));
}

}  // namespace

TEST_CASE("a drawing that needs more memory than there is does not take the others with it") {
  if (!kLimitsWork) return;
  const TempDir dir;
  writeDrawing(dir.file("huge.png"), 9000);
  fs::copy_file(kDrawing, dir.file("small.png"));
  const ToolRun run = limited(dir, 700, "skel-infer huge.png small.png --formats glb");
  CAPTURE(run.err);
  CHECK(run.exit_code == 3);
  CHECK(run.err.find("skel-infer: huge.png: needs more memory than there is\n") != std::string::npos);
  CHECK(fs::exists(dir.file("out/small.glb")));
}

TEST_CASE("wherever memory ends, there is one line and no abort") {
  if (!kLimitsWork) return;
  const TempDir dir;
  writeDrawing(dir.file("a.png"), 2500);
  bool failed = false, done = false;
  for (int mb = 40; mb <= 600; mb += 28) {
    const ToolRun run = limited(dir, mb, "skel-infer a.png --formats glb --force");
    CAPTURE(mb, run.exit_code, run.err);
    // Below, the loader itself finds no room for the libraries.
    if (run.exit_code == 127) continue;
    CHECK((run.exit_code == 0 || run.exit_code == 3));
    if (run.exit_code == 3) {
      failed = true;
      CHECK(run.err.find("skel-infer: ") == 0);
      CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    } else {
      done = true;
    }
  }
  CHECK(failed);
  CHECK(done);
}

TEST_CASE("a mask of a comb of 2000 teeth of 1 px needs no more than 1.2 GB") {
  if (!kLimitsWork) return;
  const TempDir dir;
  constexpr int kSize = 4000;
  Image comb = blankImage(kSize, kSize);
  for (int y = 40; y < kSize; ++y)
    for (int x = 1; x < kSize; x += 2) std::fill_n(comb.pixel(x, y), 3, 0);
  writeFile(dir.file("comb.png"), encodePng(comb));
  const ToolRun run = limited(dir, 1200, "skel-infer comb.png --mask comb.png --formats glb");
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
}

TEST_CASE("a long key before a long list takes no memory for each item") {
  if (!kLimitsWork) return;
  const TempDir dir;
  fs::create_directory(dir.file("in"));
  fs::copy_file(kDrawing, dir.file("in/a.png"));
  std::string zeros = "0";
  for (int i = 0; i < 20'000; ++i) zeros += ",0";
  writeFile(dir.file("in/a.joints.json"),
            "{\"joints\": {\"" + std::string(400'000, 'k') + "\": [" + zeros + "]}}");
  const ToolRun run = limited(dir, 400, "skel-label import in -o out");
  CAPTURE(run.err);
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("a.joints.json: joints.kkkkk") != std::string::npos);
}

TEST_CASE("a motion whose frames are said to be huge is looked at in little memory") {
  if (!kLimitsWork) return;
  const TempDir dir;
  fs::create_directory(dir.file("film"));
  for (const char* name : {"film/1.png", "film/2.png"}) fs::copy_file(kDrawing, dir.file(name));
  REQUIRE(runTool("cd '" + dir.path() + "' && skel-style keypoints film -o a.motion.json").exit_code == 0);
  std::string motion = readFile(dir.file("a.motion.json"));
  for (const char* side : {"\"width\":", "\"height\":"})
    for (std::size_t at = motion.find(side); at != std::string::npos; at = motion.find(side, at + 1)) {
      const std::size_t number = at + std::string_view(side).size();
      motion.replace(number, motion.find_first_not_of("0123456789", number) - number, "40000");
    }
  for (std::size_t at = motion.find("\"film/"); at != std::string::npos; at = motion.find("\"film/"))
    motion.replace(at, motion.find('"', at + 1) + 1 - at, "null");
  writeFile(dir.file("a.motion.json"), motion);
  const ToolRun run = limited(dir, 1000, "skel-style inspect a.motion.json -o a.png");
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
}

TEST_CASE("a file larger than the system allows is an output error, and leaves nothing") {
  const TempDir dir;
  fs::copy_file(kDrawing, dir.file("a.png"));
  const ToolRun run =
      runTool("cd '" + dir.path() + "' && ulimit -f 10 && skel-infer a.png -o out --formats glb");
  CAPTURE(run.err);
  CHECK(run.exit_code == 4);
  CHECK(run.err.find("out/a.glb: cannot be written") != std::string::npos);
  CHECK(fs::is_empty(dir.file("out")));
}

TEST_CASE("threads that cannot be had end no tool") {
  if (!kLimitsWork) return;
  const TempDir dir;
  std::string drawings;
  for (int i = 0; i < 12; ++i) {
    const std::string name = "a" + std::to_string(i) + ".png";
    fs::copy_file(kDrawing, dir.file(name));
    drawings += " " + name;
  }
  // Each thread's stack takes 1 GB.
  const ToolRun run =
      runTool("cd '" + dir.path() + "' && ulimit -s 1000000 && ulimit -v 2500000 && skel-infer" + drawings +
              " --jobs 12 --formats glb");
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
  CHECK(fs::exists(dir.file("out/a11.glb")));
}

TEST_CASE("a command without a batch names what it worked on when memory ends") {
  if (!kLimitsWork) return;
  const TempDir dir;
  std::string obj;
  for (int i = 0; i < 400'000; ++i)
    obj += "v " + std::to_string(i % 1000) + " " + std::to_string(i / 1000) + " 0\n";
  for (int i = 1; i < 390'000; ++i)
    obj += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 1001) + "\n";
  writeFile(dir.file("plane.obj"), obj);
  bool failed = false;
  for (int mb = 60; mb <= 600 && !failed; mb += 20) {
    const ToolRun run = limited(dir, mb, "skel-animate info plane.obj");
    // The loader itself finds no room for the libraries.
    if (run.exit_code == 127) continue;
    CAPTURE(mb, run.err);
    REQUIRE(run.exit_code == 3);
    CHECK(run.err == "skel-animate: plane.obj: needs more memory than there is\n");
    failed = true;
  }
  CHECK(failed);
}
