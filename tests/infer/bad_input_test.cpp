// What skel-infer says to bad input: one clear line, the right exit code, no half-written file.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "libskel/core/files.h"
#include "libskel/image/image.h"
#include "libskel/image/write_image.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

std::string plainPng(int width, int height, int grey, int alpha = 255) {
  Image image(width, height);
  for (int c = 0; c < 3; ++c) image.rgba.col(c).setConstant(static_cast<std::uint8_t>(grey));
  image.rgba.col(3).setConstant(static_cast<std::uint8_t>(alpha));
  return encodePng(image);
}

int filesIn(const std::string& dir) {
  int count = 0;
  if (fs::exists(dir))
    for (const auto& entry : fs::recursive_directory_iterator(dir)) count += entry.is_regular_file();
  return count;
}

// A PNG's header that promises a picture of this size and then ends.
std::string hugeHeader() {
  std::string png = plainPng(2, 2, 0);
  const auto put = [&](size_t at, unsigned value) {
    for (int i = 0; i < 4; ++i) png[at + static_cast<size_t>(i)] = static_cast<char>(value >> (24 - 8 * i));
  };
  put(16, 60000);
  put(20, 60000);
  unsigned crc = 0xffffffffu;
  for (size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<unsigned char>(png[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  put(29, ~crc);
  return png;
}

void expect(const ToolRun& run, int exit_code, const std::string& message) {
  CAPTURE(run.err);
  CHECK(run.exit_code == exit_code);
  CHECK(run.err.find(message) != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("a motion's file where a clip's name belongs is refused with what to do instead") {
  const TempDir dir;
  writeFile(dir.file("a.png"), plainPng(8, 8, 0));
  const auto clips = [&](const std::string& name) {
    return runTool("skel-infer " + dir.file("a.png") + " --clips " + name + " -o " + dir.file("out"));
  };
  expect(clips("idle,dance.bvh"), 1,
         "\"dance.bvh\" is a file; after the rig: `skel-animate retarget dance.bvh --to FILE.glb`");
  expect(clips("mine/bow.clip.json"), 1,
         "is a file; name its folder by --clips-dir, and the clip in it by its name");
  CHECK(filesIn(dir.file("out")) == 0);
}

TEST_CASE("a picture that cannot be used is refused by name, and nothing is written") {
  const TempDir dir;
  const std::string drawing = readFile(kDrawing);
  struct Case {
    const char* file;
    std::string bytes;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"empty.png", "", "empty.png: is empty"},
      {"cut.png", drawing.substr(0, drawing.size() / 2), "cut.png: "},
      {"text.png", "This is no picture.", "text.png: is not a picture that can be read"},
      {"dot.png", plainPng(1, 1, 0), "dot.png: "},
      {"white.png", plainPng(200, 200, 255), "white.png: "},
      {"black.png", plainPng(200, 200, 0), "black.png: "},
      {"clear.png", plainPng(200, 200, 90, 0), "clear.png: "},
      {"huge.png", hugeHeader(), "huge.png: "},
  };
  for (const Case& c : cases) {
    CAPTURE(c.file);
    writeFile(dir.file(c.file), c.bytes);
    expect(infer(dir, c.file), 2, c.message);
    CHECK(filesIn(dir.file("out")) == 0);
  }
  expect(infer(dir, "missing.png"), 2, "missing.png: cannot be read: No such file or directory");
}

TEST_CASE("with several pictures the good ones are rigged and the exit code is that of the first failure") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  writeFile(dir.file("b.png"), "no picture");
  const ToolRun run = infer(dir, "a.png b.png --jobs 2 --quiet");
  expect(run, 2, "b.png: ");
  CHECK(fs::exists(dir.file("out/a.glb")));
  CHECK_FALSE(fs::exists(dir.file("out/b.glb")));
}

TEST_CASE("of several drawings, one that a format is not for is named, and the others have it") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  writeFile(dir.file("dog.png"), readFile(SKEL_SOURCE_DIR "/datasets/animals/box_dog.png"));
  expect(infer(dir, "a.png dog.png --formats char_cfg --quiet"), 1,
         "dog.png: the format char_cfg is for bipeds");
  CHECK(fs::exists(dir.file("out/a/char_cfg.yaml")));
}

TEST_CASE("wrong usage is told before any work") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  writeFile(dir.file("more/a.png"), readFile(kDrawing));
  expect(infer(dir, ""), 1, "name an image, or --model; see --help");
  expect(infer(dir, "a.png more/a.png"), 1,
         "a.png and more/a.png would both write out/a.*; rename one or run them with different -o");
  writeFile(dir.file("a.jpg"), readFile(kDrawing));
  expect(infer(dir, "a.jpg a.png"), 1, "if one is the other taken again, move the older one elsewhere");
  expect(infer(dir, "a.png b.png --mask m.png"), 1, "--mask goes with one image, 2 were given");
  expect(infer(dir, "a.png b.png --skeleton s.json"), 1, "--skeleton goes with one image, 2 were given");
  expect(infer(dir, "a.png b.png --layers l.png"), 1, "--layers FILE goes with one image, 2 were given");
  expect(infer(dir, "a.png --figure all --layers l.png"), 1,
         "--layers FILE goes with one figure, not with --figure all");
  expect(infer(dir, "a.png --figure 0"), 1, "--figure is \"0\", must be 1, 2, ... or all");
  expect(infer(dir, "a.png --recognizer magic"), 1, "--recognizer: magic not in {");
  expect(infer(dir, "a.png --formats glb,fbx"), 1, "--formats: fbx not in {");
  expect(infer(dir, "a.png --max-influences 9"), 1, "--max-influences: Value 9 not in range");
  expect(infer(dir, "a.png --clips moonwalk"), 1, "moonwalk");
  expect(infer(dir, "a.png --colour red"), 1, "--colour");
  CHECK(filesIn(dir.file("out")) == 0);
  const ToolRun help = infer(dir, "--help");
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
  CHECK(help.out.find("--skeleton") != std::string::npos);
}

TEST_CASE("masks, weights, templates and models that do not fit are refused") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  writeFile(dir.file("small.png"), plainPng(30, 20, 255));
  expect(infer(dir, "a.png --mask small.png"), 2, "small.png: is a mask of 30x20 px, the image has 600x600");
  expect(infer(dir, "a.png --layers small.png"), 2,
         "small.png: is a layer map of 30x20 px, the image has 600x600");
  expect(infer(dir, "a.png --layers a.png"), 2, "which is no limb's; paint with the colours that --formats");
  writeFile(dir.file("blank.png"), plainPng(600, 600, 0));
  expect(infer(dir, "a.png --mask blank.png"), 2, "blank.png: the mask is blank");
  expect(infer(dir, "a.png --template centaur"), 2, "centaur: is no template; use one of: biped, quadruped");
  std::string weights = readFile(SKEL_SOURCE_DIR "/weights/default.json");
  const size_t at = weights.find("\"layers\"");
  REQUIRE(at != std::string::npos);
  weights.replace(weights.find('3', at), 1, "5");
  writeFile(dir.file("w.json"), weights);
  expect(infer(dir, "a.png --weights w.json"), 2, "w.json: ");
  writeFile(dir.file("m.obj"), "v 0 0 0\nv 1 0 0\nf 1 2 7\n");
  expect(infer(dir, "a.png --model m.obj"), 2, "m.obj: line 3");
  CHECK(filesIn(dir.file("out")) == 0);
}

TEST_CASE("weights that decide nothing are said to") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  const std::string weights = " --weights " SKEL_SOURCE_DIR "/weights/default.json";
  const std::string note = "--weights needs --recognizer paper, --formats features or --trace";
  const auto says = [&](const std::string& arguments) {
    const ToolRun run = infer(dir, "a.png" + weights + arguments);
    CHECK(run.exit_code == 0);
    return run.err.find(note) != std::string::npos;
  };
  CHECK(says(""));
  CHECK_FALSE(says(" --recognizer paper"));
  CHECK_FALSE(says(" --formats features"));
  const std::string net = "a.png --formats json --joint-net " SKEL_SOURCE_DIR "/weights/joint_net.bin";
  const std::string unused = "--joint-net needs --recognizer tree\n";
  CHECK(infer(dir, net + " --recognizer paper").err.find(unused) != std::string::npos);
  CHECK(infer(dir, net).err.find(unused) == std::string::npos);
}

TEST_CASE("a folder that cannot be written to is an output error") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  writeFile(dir.file("taken"), "x");
  for (const char* option : {"--trace taken/below", "--report taken/below/r.html"}) {
    expect(infer(dir, std::string("a.png -o out ") + option), 4, "taken/below: cannot be made");
    CHECK(fs::is_empty(dir.file("out")));
  }
  if (::geteuid() == 0) {
    // Root may write anywhere; a file in the folder's place stops it, too.
    expect(infer(dir, "a.png -o taken"), 4, "taken: is not a folder; name another with -o");
    expect(infer(dir, "a.png -o taken/below"), 4, "taken/below: cannot be made");
    return;
  }
  fs::create_directory(dir.file("locked"));
  ::chmod(dir.file("locked").c_str(), 0500);
  expect(infer(dir, "a.png -o locked"), 4, "locked: cannot be written to");
}
