// skel-train joints: the same net whatever the number of threads, and after a stop.
#include <filesystem>

#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

namespace skel {
namespace {

std::string command(const TempDir& dir, const std::string& output, const std::string& options) {
  return "'" SKEL_TRAIN "' joints --steps 6 --batch 4 --figures 64 --validation 8 --report-every 1 -o '" +
         dir.file(output) + "' " + options;
}

// One drawing to learn from.
std::string drawings(const TempDir& dir) {
  std::filesystem::create_directories(dir.file("drawings"));
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy" + std::string(end),
                               dir.file("drawings/cap_boy") + end);
  return " --drawn .5 --drawings '" + dir.file("drawings") + "'";
}

TEST_CASE("joint training gives the same bytes with one thread and with several") {
  const TempDir dir;
  const std::string from = drawings(dir);
  REQUIRE(runTool(command(dir, "one.bin", "--threads 1" + from)).exit_code == 0);
  REQUIRE(runTool(command(dir, "three.bin", "--threads 3" + from)).exit_code == 0);
  REQUIRE(runTool(command(dir, "other.bin", "--seed 2 --threads 3" + from)).exit_code == 0);
  CHECK(readFile(dir.file("one.bin")) == readFile(dir.file("three.bin")));
  CHECK(readFile(dir.file("one.bin")) != readFile(dir.file("other.bin")));
}

TEST_CASE("joint training that was killed goes on from its checkpoint to the same net") {
  const TempDir dir;
  const std::string from = drawings(dir), checkpoint = dir.file("state");
  REQUIRE(runTool(command(dir, "whole.bin", from)).exit_code == 0);
  const std::string resumable = command(dir, "resumed.bin", "--checkpoint '" + checkpoint + "'" + from);
  runTool("sh -c \"" + resumable + " & pid=\\$!; while [ ! -e '" + checkpoint +
          "' ] && kill -0 \\$pid; do sleep 0.01; done; kill -9 \\$pid; wait\"");
  REQUIRE(std::filesystem::exists(checkpoint));
  const auto resumed = runTool(resumable);
  REQUIRE(resumed.exit_code == 0);
  CHECK(readFile(dir.file("whole.bin")) == readFile(dir.file("resumed.bin")));
  // Its first report is not the first of all.
  CHECK(resumed.out.find("step 1 ") == std::string::npos);
}

TEST_CASE("joint training refuses what it cannot go on from or learn from") {
  const TempDir dir;
  writeFile(dir.file("state"), "short");
  const auto bad = runTool(command(dir, "n.bin", "--checkpoint '" + dir.file("state") + "'"));
  CHECK(bad.exit_code == 2);
  CHECK(bad.err.find("is no checkpoint of this net: remove it to start anew") != std::string::npos);
  CHECK(runTool(command(dir, "n.bin", "--hold-back 99")).exit_code == 1);
  const auto empty = runTool(command(dir, "n.bin", "--drawings '" + dir.path() + "'"));
  CHECK(empty.exit_code == 2);
  CHECK(empty.err.find("has no drawing with joints.json and mask.png") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(dir.file("n.bin")));
}

}  // namespace
}  // namespace skel
