// skel-label without its window, as a user would call it.
#include <filesystem>

#include <algorithm>

#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "tests/labeler/drawing_folder.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

ToolRun label(const TempDir& dir, const std::string& arguments) {
  return runTool("cd '" + dir.path() + "' && env -u DISPLAY -u WAYLAND_DISPLAY '" SKEL_LABEL "' " +
                 arguments);
}

void replaceIn(const std::string& file, const std::string& from, const std::string& to) {
  std::string text = readFile(file);
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  writeFile(file, text.replace(at, from.size(), to));
}

}  // namespace

TEST_CASE("wrong arguments are refused with one line") {
  const TempDir dir;
  fs::create_directories(dir.file("empty"));
  copyCharacter("cap_boy", dir.file("good"));
  struct Case {
    std::string arguments;
    int exit_code;
    std::string line;
  };
  const std::vector<Case> cases = {
      {"", 1, "skel-label: name a folder of pictures, a picture or a skeleton file (see --help)\n"},
      {"--colour good", 1, "skel-label: The following argument was not expected: --colour\n"},
      {"check", 1, "skel-label: dir is required\n"},
      {"export good", 1, "skel-label: export needs either --coco or --csv\n"},
      {"export good --csv --coco", 1, "skel-label: export needs either --coco or --csv\n"},
      {"nowhere", 2, "skel-label: nowhere: cannot be read: No such file or directory\n"},
      {"empty", 2, "skel-label: empty: holds no picture (.png, .jpg, .webp, .bmp, .tif, .gif)\n"},
      {"good --weights nowhere.json", 2,
       "skel-label: nowhere.json: cannot be read: No such file or directory\n"},
      {"good --template nowhere.json", 2, "nowhere.json"},
      {"candidates nowhere", 2, "skel-label: nowhere: is not a folder\n"},
      {"candidates empty", 2, "skel-label: empty: holds no picture (.png, .jpg, .webp, .bmp, .tif, .gif)\n"},
      {"import nowhere", 2, "skel-label: nowhere: is not a folder\n"},
      {"import empty", 2, "skel-label: empty: holds nothing to import"},
      {"check empty", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"stats empty", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"export empty --csv", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"import good -o good/cap_boy.png", 4, "cap_boy.png"},
  };
  for (const Case& wrong : cases) {
    INFO(wrong.arguments);
    const ToolRun run = label(dir, wrong.arguments);
    CHECK(run.exit_code == wrong.exit_code);
    CHECK(contains(run.err, wrong.line));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
}

TEST_CASE("without a display the window says so") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const ToolRun run = label(dir, "cap_boy.png");
  CHECK(run.exit_code == 3);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

TEST_CASE("help names the commands") {
  const TempDir dir;
  const ToolRun run = label(dir, "--help");
  CHECK(run.exit_code == 0);
  for (const char* command : {"candidates", "import", "check", "stats", "export"})
    CHECK(contains(run.out, command));
}

TEST_CASE("candidates: empty label files where there are none, at any depth") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("a/b"));
  copyCharacter("box_robot", dir.file("a"), false);
  CHECK(label(dir, "candidates .").out == "2 label files made, 0 kept as they were, 0 failed\n");
  const LabelFile with_mask = readLabelFile(dir.file("a/b/cap_boy.labels.json"));
  CHECK(with_mask.mask->file == "cap_boy.mask.png");
  CHECK(with_mask.candidates.size() > 20);
  for (const auto& one : with_mask.labels) CHECK_FALSE(one);
  CHECK_FALSE(readLabelFile(dir.file("a/box_robot.labels.json")).mask);
  CHECK(label(dir, "candidates .").out == "0 label files made, 2 kept as they were, 0 failed\n");
  CHECK(label(dir, "check .").exit_code == 0);

  writeFile(dir.file("broken.png"), "no picture");
  const ToolRun run = label(dir, "candidates .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "broken.png"));
  CHECK(run.out == "0 label files made, 2 kept as they were, 1 failed\n");
}

TEST_CASE("import: beside the pictures, or copied; labels of a person are kept unless forced") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in/a"));
  copyCharacter("box_robot", dir.file("in"));
  CHECK(label(dir, "import in -o out").out == "2 label files made, 0 kept as they were, 0 failed\n");
  CHECK_FALSE(fs::exists(dir.file("in/a/cap_boy.labels.json")));
  CHECK(readFile(dir.file("out/a/cap_boy.png")) == readFile(dir.file("in/a/cap_boy.png")));
  CHECK(readFile(dir.file("out/a/cap_boy.mask.png")) == readFile(dir.file("in/a/cap_boy.mask.png")));
  CHECK(label(dir, "check out").exit_code == 0);
  const LabelledSet set = readLabelledSet(dir.file("out"));
  CHECK(set.characters.size() == 2);

  CHECK(label(dir, "import in").out == "2 label files made, 0 kept as they were, 0 failed\n");
  const std::string path = dir.file("in/a/cap_boy.labels.json"), made = readFile(path);
  CHECK(made == readFile(dir.file("out/a/cap_boy.labels.json")));
  LabelFile mended = readLabelFile(path);
  mended.labels[0] = JointClass::kLeg;
  mended.labels[1] = std::nullopt;
  writeLabelFile(path, mended);
  const std::string by_hand = readFile(path);
  CHECK(label(dir, "import in").out == "0 label files made, 2 kept as they were, 0 failed\n");
  CHECK(readFile(path) == by_hand);
  CHECK(label(dir, "import in --force").out == "2 label files made, 0 kept as they were, 0 failed\n");
  CHECK(readFile(path) == made);
}

TEST_CASE("import: a joint outside its picture, a mask of another size, a joint of no template") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("box_robot", dir.path());
  const std::string joints = dir.file("cap_boy.joints.json"), original = readFile(joints);
  writeFile(joints, R"({"joints": {"head": [700, 3]}})");
  ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "cap_boy.joints.json: joint head lies outside"));
  CHECK(run.out == "1 label files made, 0 kept as they were, 1 failed\n");

  writeFile(joints, R"({"joints": {"wing": [7, 3]}})");
  run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "cap_boy.joints.json: joints.wing: is no joint of the template biped"));

  writeFile(joints, original);
  writeFile(dir.file("cap_boy.mask.png"), encodePng(Plane8(Plane8::Constant(5, 5, 255))));
  run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "cap_boy.mask.png: has 5x5 px, its drawing has 600x600"));
}

TEST_CASE("check names every inconsistency with file and path") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("box_robot", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  CHECK(label(dir, "check .").out == "no inconsistencies\n");

  const std::string path = dir.file("cap_boy.labels.json");
  const LabelFile good = readLabelFile(path);
  LabelFile bad = good;
  bad.candidates[2].radius += 1;
  bad.joints[0].first = "wing";
  writeLabelFile(path, bad);
  replaceIn(dir.file("box_robot.labels.json"), "\"label\": \"", "\"label\": \"x");
  ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "cap_boy.labels.json: joints.wing: is no joint of the template biped"));
  CHECK(contains(run.err, "cap_boy.labels.json: candidates[2]: is not the figure's"));
  CHECK(contains(run.err, "box_robot.labels.json: candidates[0].label"));

  bad = good;
  bad.candidates.pop_back();
  bad.labels.pop_back();
  writeLabelFile(path, bad);
  CHECK(contains(label(dir, "check .").err, "the figure has " + std::to_string(good.candidates.size())));

  writeLabelFile(path, good);
  writeFile(dir.file("cap_boy.mask.png"), readFile(dir.file("box_robot.mask.png")));
  CHECK(contains(label(dir, "check .").err,
                 "cap_boy.labels.json: mask.file: \"cap_boy.mask.png\" has changed"));
}

TEST_CASE("stats and the table count the same candidates") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  labels.labels[0] = std::nullopt;
  writeLabelFile(dir.file("cap_boy.labels.json"), labels);
  const std::string stats = label(dir, "stats .").out;
  const std::string count = std::to_string(labels.candidates.size());
  CHECK(contains(stats, "drawings          1\n"));
  CHECK(contains(stats, "finished          0    0.0 %"));
  CHECK(contains(stats, "candidates   " + std::string(6 - count.size(), ' ') + count + "\n"));

  CHECK(label(dir, "export . --csv").out == "out/labels.csv\n");
  const std::string csv = readFile(dir.file("out/labels.csv"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + static_cast<long>(labels.candidates.size()));
  CHECK(csv.starts_with(
      "file,candidate,x,y,radius,feature_x,feature_y,feature_radius,label\ncap_boy.labels.json,0,"));
  CHECK(csv.substr(0, csv.find("cap_boy.labels.json,1,")).ends_with(",\n"));  // the one without label
}

TEST_CASE("COCO: out and in again gives the same labels") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in/a"));
  copyCharacter("box_robot", dir.file("in"));
  REQUIRE(label(dir, "import in").exit_code == 0);
  REQUIRE(label(dir, "export in --coco -o round/coco.json").exit_code == 0);
  fs::create_directories(dir.file("round/a"));
  fs::copy(dir.file("in/a/cap_boy.png"), dir.file("round/a/cap_boy.png"));
  fs::copy(dir.file("in/box_robot.png"), dir.file("round/box_robot.png"));
  REQUIRE(label(dir, "import round").exit_code == 0);
  for (const char* name : {"a/cap_boy", "box_robot"}) {
    const LabelFile there = readLabelFile(dir.file(std::string("in/") + name + ".labels.json"));
    const LabelFile back = readLabelFile(dir.file(std::string("round/") + name + ".labels.json"));
    CHECK(back.labels == there.labels);
    CHECK(back.candidates.size() == there.candidates.size());
  }
}
