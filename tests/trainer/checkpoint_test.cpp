// What a checkpoint of skel-train was made by, for each training that has them.
#include <filesystem>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

namespace skel {
namespace {

const std::string kWeights = SKEL_DATASETS "/../weights/";

std::string quoted(const std::string& text) { return "'" + text + "'"; }

// A folder of one drawing to learn from, for skel-train parts with a picture of its shapes.
std::string folderOf(const TempDir& dir, const std::string& name) {
  const std::string folder = dir.file(name), drawing = SKEL_DATASETS "/characters/" + name;
  std::filesystem::create_directories(folder);
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(drawing + end, folder + "/" + name + end);
  std::filesystem::create_directories(dir.file("shapes/" + name));
  std::filesystem::copy_file(drawing + ".png", dir.file("shapes/" + name + "/" + name + ".shapes.png"));
  return folder;
}

// Names of the options that a command's help has.
std::set<std::string> optionsOf(const std::string& command) {
  std::set<std::string> names;
  std::istringstream lines(runTool(command + " --help").out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) continue;
    const std::size_t first = line.find("--");
    names.insert(line.substr(first, line.find_first_of(" ,", first) - first));
  }
  return names;
}

struct OtherValue {
  std::string option, value;
};

// A training of a step, and each of its options with another value than `base` gives it.
void refusesOthers(const std::string& command, const std::string& base, const std::vector<OtherValue>& others,
                   const std::set<std::string>& instead_of_training) {
  const TempDir dir;
  const std::string state = dir.file("state"),
                    train = command + " -o " + quoted(dir.file("net.bin")) + " --checkpoint " + quoted(state);
  // The last of a value that is given twice counts for none of them.
  const auto line = [&](const OtherValue& other) {
    std::string text = train + " " + base;
    if (const std::size_t at = text.find(" " + other.option + " "); at != std::string::npos) {
      const std::size_t value = at + other.option.size() + 2, end = text.find(' ', value);
      return text.replace(value, end - value, other.value);
    }
    return text + other.option + " " + other.value;
  };
  const auto first = runTool(train + " " + base);
  CAPTURE(first.err);
  REQUIRE(first.exit_code == 0);
  const std::string net = readFile(dir.file("net.bin"));
  std::set<std::string> known = instead_of_training;
  known.insert({"--help", "--output", "--checkpoint", "--threads", "--report-every", "--steps"});
  for (const OtherValue& other : others) {
    known.insert(other.option);
    const auto run = runTool(line(other));
    CAPTURE(line(other), run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.starts_with("skel-train: " + state + ": was made by " + other.option + " "));
    CHECK(run.err.find(", this training is by ") != std::string::npos);
    CHECK(readFile(dir.file("net.bin")) == net);
  }
  CHECK(optionsOf(command) == known);
  // Where it goes and how fast is free, and it may go on by more steps.
  std::filesystem::remove(dir.file("net.bin"));
  const auto done = runTool(line({"--threads", "1"}));
  CHECK(done.exit_code == 0);
  CHECK(done.err.find("has made all steps") != std::string::npos);
  CHECK(readFile(dir.file("net.bin")) == net);
  const auto more = runTool(line({"--steps", "2"}) + " --report-every 7 --threads 1");
  CAPTURE(more.err);
  CHECK(more.exit_code == 0);
  CHECK(readFile(dir.file("net.bin")).find("step 2 of 1, then 2, batch 4") != std::string::npos);
  const auto fewer = runTool(train + " " + base);
  CHECK(fewer.exit_code == 2);
  CHECK(fewer.err.find("was made by --steps 2, this training is by 1: ") != std::string::npos);
}

}  // namespace

TEST_CASE("a joint training goes on from its checkpoint by the same options alone") {
  const TempDir dir;
  const std::string mine = folderOf(dir, "cap_boy"), known = folderOf(dir, "ninja");
  refusesOthers("skel-train joints",
                "--steps 1 --batch 4 --figures 64 --validation 8 --left-out 0 --start " +
                    quoted(kWeights + "joint_net.bin") + " --drawings " + quoted(mine) + " --rehearse " +
                    quoted(known) + " ",
                {{"--start", quoted(kWeights + "archive/joint-net-pass-6.bin")},
                 {"--drawings", quoted(known)},
                 {"--rehearse", quoted(mine)},
                 {"--hourglasses", "2"},
                 {"--seed", "2"},
                 {"--batch", "8"},
                 {"--rate", ".1"},
                 {"--weight-decay", ".1"},
                 {"--averaging", ".1"},
                 {"--figures", "65"},
                 {"--passes", "2"},
                 {"--others", ".1"},
                 {"--no-look", ".1"},
                 {"--no-colours", ".1"},
                 {"--drawn", ".1"},
                 {"--hard", "2"},
                 {"--left-out", ".1"},
                 {"--hold-back", "1"},
                 {"--validation", "9"}},
                {"--template"});
  const std::string from = "--steps 1 --batch 4 --figures 64 --validation 8 -o " + quoted(dir.file("n.bin")) +
                           " --checkpoint " + quoted(dir.file("n"));
  REQUIRE(runTool("skel-train joints " + from).exit_code == 0);
  const auto animals = runTool("skel-train joints --template quadruped " + from);
  CHECK(animals.exit_code == 2);
  CHECK(animals.err.find("was made by --template biped, this training is by quadruped") != std::string::npos);
}

TEST_CASE("a training of pages goes on from its checkpoint by the same options alone") {
  const TempDir dir;
  refusesOthers("skel-train pages", "--steps 1 --batch 4 --validation 1 ",
                {{"--start", quoted(kWeights + "page_net.bin")},
                 {"--seed", "2"},
                 {"--batch", "5"},
                 {"--rate", ".1"},
                 {"--drawings", quoted(folderOf(dir, "cap_boy"))},
                 {"--drawn", ".1"},
                 {"--validation", "2"}},
                {"--sheet"});
}

TEST_CASE("a training of parts goes on from its checkpoint by the same options alone") {
  const TempDir dir;
  const std::string mine = quoted(folderOf(dir, "cap_boy")), shapes = quoted(dir.file("shapes"));
  refusesOthers("skel-train parts", "--steps 1 --batch 4 ",
                {{"--start", quoted(kWeights + "part_net.bin")},
                 {"--seed", "2"},
                 {"--batch", "5"},
                 {"--rate", ".1"},
                 {"--averaging", ".1"},
                 {"--drawings", mine + " --shapes " + shapes},
                 {"--held-out", mine + " --shapes " + shapes},
                 {"--drawn", ".1"},
                 {"--posed", ".1"},
                 {"--things", ".1"},
                 {"--animals", ".1"}},
                {"--sheet", "--truth", "--shapes"});
}

TEST_CASE(
    "a checkpoint knows drawings and nets by what is in them: a picture that was painted over is another") {
  const TempDir dir;
  const std::string drawings = folderOf(dir, "cap_boy"), state = dir.file("state");
  const auto train = [&](const std::string& folder) {
    return runTool("skel-train joints --steps 1 --batch 4 --figures 64 --validation 8 -o " +
                   quoted(dir.file("net.bin")) + " --checkpoint " + quoted(state) + " --drawings " +
                   quoted(folder));
  };
  REQUIRE(train(drawings).exit_code == 0);
  std::filesystem::rename(drawings, dir.file("moved"));
  CHECK(train(dir.file("moved")).err.find("has made all steps") != std::string::npos);
  writeFile(dir.file("moved/cap_boy.png"), readFile(dir.file("moved/cap_boy.png")) + "x");
  CHECK(train(dir.file("moved")).err.find("was made by --drawings 1 drawing") != std::string::npos);
}

TEST_CASE("a checkpoint of a former version, without what it was made by, and a damaged one are refused") {
  const TempDir dir;
  const std::string state = dir.file("state"),
                    train = "skel-train pages --steps 2 --batch 4 --validation 1 -o " +
                            quoted(dir.file("net.bin")) + " --checkpoint " + quoted(state);
  REQUIRE(runTool(train).exit_code == 0);
  const std::string bytes = readFile(state);
  const auto says = [&](const std::string& content, const std::string& what) {
    writeFile(state, content);
    const auto run = runTool(train);
    CAPTURE(what, run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find(what) != std::string::npos);
    CHECK(readFile(state) == content);
  };
  const std::size_t line = bytes.find('\n');
  says(bytes.substr(line + 1), "comes from a former version of skel-train, which did not keep by what");
  says(bytes.substr(0, line / 2), "JSON");
  std::string newer = bytes;
  newer.replace(newer.find("\"version\":1"), 11, "\"version\":9");
  says(newer, "version: is 9, this program reads up to 1; use a newer skel");
  const std::string of_pages = bytes;
  writeFile(state, of_pages);
  const auto joints = runTool("skel-train joints --steps 1 --batch 4 --figures 64 --validation 8 -o " +
                              quoted(dir.file("n.bin")) + " --checkpoint " + quoted(state));
  CHECK(joints.exit_code == 2);
  CHECK(joints.err.find("was made by skel-train pages, this training is by joints") != std::string::npos);
}

TEST_CASE("a checkpoint that is cut off is said to be so") {
  const TempDir dir;
  const std::string state = dir.file("state"),
                    train = "skel-train pages --steps 1 --batch 4 --validation 1 -o " +
                            quoted(dir.file("net.bin")) + " --checkpoint " + quoted(state);
  REQUIRE(runTool(train).exit_code == 0);
  const std::string whole = readFile(state);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, whole.find('\n') + 1}) {
    writeFile(state, whole.substr(0, size));
    const auto run = runTool(train);
    CHECK(run.exit_code == 2);
    CHECK(run.err == "skel-train: " + state + ": is cut off: remove it to start anew\n");
  }
}

}  // namespace skel
