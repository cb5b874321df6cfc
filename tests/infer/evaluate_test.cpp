// skel-infer evaluate against the scorer that comes with the real drawings. Both need those drawings.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "libskel/core/json.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

namespace {

// The summary line without the bootstrap intervals, whose random numbers differ.
std::string summary(const std::string& text) {
  const size_t start = text.find("mean over ");
  std::string line = text.substr(start, text.find('\n', start) - start);
  for (size_t open; (open = line.find('[')) != std::string::npos;)
    line.erase(open, line.find(']') - open + 1);
  return line;
}

}  // namespace

TEST_CASE("evaluate gives the figures of the scorer in Python") {
  const char* real = std::getenv("SKEL_EVAL_DIR");
  if (!real || skel::runTool("python3 --version").exit_code != 0) {
    WARN("SKIPPED: needs SKEL_EVAL_DIR and python3");
    return;
  }
  const skel::TempDir dir;
  const std::string drawings = std::string(real) + "/characters";
  const auto python = skel::runTool("python3 '" + std::string(real) + "/score.py' --truth '" + drawings +
                                    "' --infer '" SKEL_INFER "' --given-mask --out '" + dir.path() + "'");
  const auto ours = skel::runTool("'" SKEL_INFER "' evaluate '" + drawings + "' --given-mask --jobs 0");
  REQUIRE(python.exit_code == 0);
  REQUIRE(ours.exit_code == 0);
  CAPTURE(python.out, ours.out);
  CHECK(summary(ours.out) == summary(python.out));
  CHECK(python.out.find("CRASH") == std::string::npos);
}

TEST_CASE("evaluate draws what it found and writes the figures") {
  const skel::TempDir dir;
  const std::string folder = dir.path() + "/set";
  std::filesystem::create_directories(folder);
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                               folder + "/cap_boy" + end);
  const auto done = skel::runTool("'" SKEL_INFER "' evaluate '" + folder + "' --given-mask --overlays '" +
                                  dir.path() + "/pictures' --json '" + dir.path() + "/figures.json'");
  CAPTURE(done.out);
  REQUIRE(done.exit_code == 0);
  CHECK(std::filesystem::exists(dir.path() + "/pictures/cap_boy.png"));
  const skel::JsonDocument figures = skel::JsonDocument::readFile(dir.path() + "/figures.json");
  CHECK(figures.root().at("characters").at("cap_boy").at("pck10").asNumber() == 1);
  CHECK_FALSE(figures.root().at("characters").at("cap_boy").at("worst_joint").asString().empty());
}

TEST_CASE("evaluate goes on after a drawing that cannot be read, and says so") {
  const skel::TempDir dir;
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    for (const std::string name : {"good", "broken"})
      std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                                 dir.file(name + end));
  std::filesystem::resize_file(dir.file("broken.png"), 5000);
  const auto run = skel::runTool("'" SKEL_INFER "' evaluate '" + dir.path() + "' --given-mask");
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("broken.png: ") != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  CHECK(run.out.find("mean over 1 characters") != std::string::npos);
}
