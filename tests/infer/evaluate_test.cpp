// skel-infer evaluate against the scorer that comes with the real drawings. Both need those drawings.
#include <cstdlib>
#include <sstream>

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
