// skel-label without its window, as a user would call it.
#include <filesystem>

#include <algorithm>
#include <utility>

#include "labeler/annotated_drawing.h"
#include "labeler/drawing_list.h"
#include "labeler/make_motion.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "tests/labeler/drawing_folder.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

ToolRun label(const TempDir& dir, const std::string& arguments) {
  return runTool("cd '" + dir.path() + "' && env -u DISPLAY -u WAYLAND_DISPLAY skel-label " + arguments);
}

void replaceIn(const std::string& file, const std::string& from, const std::string& to) {
  std::string text = readFile(file);
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  writeFile(file, text.replace(at, from.size(), to));
}

// Of a picture of the labelled set that lies in `dir`, the head placed by a person.
void writeSkeleton(const TempDir& dir, const std::string& name, double head_x) {
  SkeletonFile file;
  file.image_file = name + ".png";
  file.image_sha256 = sha256(readFile(kCharacters + name + ".png"));
  file.image_width = file.image_height = 600;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {150, 50}, {450, 550});
  Joint& head = file.skeleton.joints[static_cast<size_t>(file.skeleton.index("head"))];
  head.origin = JointOrigin::kEdited;
  head.image.x() = head_x;
  writeFile(dir.file(name + ".skeleton.json"), formatSkeletonFile(file));
}

// With its skeleton; returns the label file that is made of both.
std::string importedBoy(const TempDir& dir) {
  fs::copy(kCharacters + "cap_boy.png", dir.file("cap_boy.png"));
  writeSkeleton(dir, "cap_boy", 300);
  REQUIRE(label(dir, "import .").exit_code == 0);
  return dir.file("cap_boy.labels.json");
}

double headOf(const std::string& label_file) {
  for (const auto& [name, place] : readLabelFile(label_file).joints)
    if (name == "head" && place) return place->x();
  return -1;
}

// Two drawings to round/coco.json, beside the picture of one of them, cap_boy.
void exportTwo(const TempDir& dir) {
  copyCharacter("cap_boy", dir.file("in"));
  copyCharacter("box_robot", dir.file("in"));
  REQUIRE(label(dir, "import in").exit_code == 0);
  REQUIRE(label(dir, "export in --coco -o round/coco.json").exit_code == 0);
  fs::copy(dir.file("in/cap_boy.png"), dir.file("round/cap_boy.png"));
}

}  // namespace

TEST_CASE("wrong arguments are refused with one line") {
  const TempDir dir;
  fs::create_directories(dir.file("empty"));
  copyCharacter("cap_boy", dir.file("good"));
  fs::create_directories(dir.file("loop"));
  fs::create_symlink("a.labels.json", dir.file("loop/a.labels.json"));
  struct Case {
    std::string arguments;
    int exit_code;
    std::string line;
  };
  const std::vector<Case> cases = {
      {"", 1,
       "skel-label: name a folder of pictures, a picture, a skeleton file or a motion file (see --help)\n"},
      {"--colour good", 1, "skel-label: The following argument was not expected: --colour\n"},
      {"check", 1, "skel-label: dir is required\n"},
      {"export good", 1, "skel-label: export needs either --coco or --csv\n"},
      {"export good --csv --coco", 1, "skel-label: export needs either --coco or --csv\n"},
      {"nowhere", 2, "skel-label: nowhere: cannot be read: No such file or directory\n"},
      {"empty", 2, "skel-label: empty: holds no picture (.png, .jpg, .webp, .bmp, .tif, .gif)\n"},
      {"good --weights nowhere.json", 2,
       "skel-label: nowhere.json: cannot be read: No such file or directory\n"},
      {"good --template nowhere.json", 2, "nowhere.json"},
      {"candidates nowhere", 2, "skel-label: nowhere: does not exist\n"},
      {"candidates empty", 2, "skel-label: empty: holds no picture (.png, .jpg, .webp, .bmp, .tif, .gif)\n"},
      {"import nowhere", 2, "skel-label: nowhere: does not exist\n"},
      {"import nowhere.coco.json", 2, "skel-label: nowhere.coco.json: does not exist\n"},
      {"import empty", 2, "skel-label: empty: holds nothing to import"},
      {"check empty", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"stats empty", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"export empty --csv", 2, "skel-label: empty: holds no label files (*.labels.json)"},
      {"import good -o good/cap_boy.png", 4, "cap_boy.png"},
      {"good --recognizer magic", 1, "--recognizer"},
      {"nowhere.motion.json", 2,
       "skel-label: nowhere.motion.json: cannot be read: No such file or directory\n"},
      {"motion empty", 2, "skel-label: empty: holds no picture (.png, .jpg, .webp, .bmp, .tif, .gif)\n"},
      {"motion good --frame-rate 0", 1, "--frame-rate"},
      {"motion good -o good/cap_boy.png/x.motion.json", 4, "cap_boy.png"},
      {"check loop", 2,
       "skel-label: loop/a.labels.json: cannot be read: Too many levels of symbolic links\n"},
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
  for (const char* command : {"candidates", "import", "check", "stats", "export", "motion"})
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

TEST_CASE("candidates made an empty label file for a renamed picture without a word of its labels") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  CHECK(label(dir, "candidates .").err.empty());
  fs::rename(dir.file("cap_boy.png"), dir.file("ben.png"));
  if (GENERATE(false, true))
    writeLabelFile(dir.file("ben.labels.json"),
                   labelImage(dir.file("ben.png"), std::nullopt, {}, loadTemplate("biped")));
  const ToolRun run = label(dir, "candidates .");
  CHECK(contains(run.out, "1 label files made"));
  CHECK(run.err ==
        "skel-label: note: ./ben.labels.json: as in cap_boy.labels.json, made when the picture was called "
        "cap_boy.png\n");
  LabelFile labels = readLabelFile(dir.file("ben.labels.json"));
  CHECK(std::exchange(labels.image.file, "cap_boy.png") == "ben.png");
  CHECK(formatLabelFile(labels) == readFile(dir.file("cap_boy.labels.json")));
  CHECK(label(dir, "candidates .").err.empty());
}

TEST_CASE("a photo in HEIC was no reason to refuse the folder that holds its converted picture, too") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("class"), false);
  fs::rename(dir.file("class/cap_boy.png"), dir.file("class/Ömer.png"));
  writeFile(dir.file("class/Ömer.heic"), "no picture");
  CHECK(findDrawings(dir.file("class")).size() == 1);
  const ToolRun run = label(dir, "candidates class");
  CHECK(run.exit_code == 0);
  CHECK(run.err.empty());
  CHECK(run.out == "1 label files made, 0 kept as they were, 0 failed\n");
  // One that nobody has converted is told of.
  writeFile(dir.file("class/Eva.heic"), "no picture");
  CHECK(contains(label(dir, "candidates class").err, "class/Eva.heic: "));
}

TEST_CASE("import: beside the pictures, or copied, and labels of a person are kept unless forced") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in/a"));
  copyCharacter("box_robot", dir.file("in"));
  CHECK(label(dir, "import in -o out").out ==
        "2 label files made, 0 kept as they were, 0 failed\n28 joints placed, 0 found\nwritten into out, "
        "out/a\n");
  CHECK_FALSE(fs::exists(dir.file("in/a/cap_boy.labels.json")));
  CHECK(readFile(dir.file("out/a/cap_boy.png")) == readFile(dir.file("in/a/cap_boy.png")));
  CHECK(readFile(dir.file("out/a/cap_boy.mask.png")) == readFile(dir.file("in/a/cap_boy.mask.png")));
  CHECK(label(dir, "check out").exit_code == 0);
  const LabelledSet set = readLabelledSet(dir.file("out"));
  CHECK(set.characters.size() == 2);

  CHECK(label(dir, "import in").out ==
        "2 label files made, 0 kept as they were, 0 failed\n28 joints placed, 0 found\nwritten into in, "
        "in/a\n");
  const std::string path = dir.file("in/a/cap_boy.labels.json"), made = readFile(path);
  CHECK(made == readFile(dir.file("out/a/cap_boy.labels.json")));
  LabelFile mended = readLabelFile(path);
  mended.labels[0] = JointClass::kLeg;
  mended.labels[1] = std::nullopt;
  writeLabelFile(path, mended);
  const std::string by_hand = readFile(path);
  CHECK(label(dir, "import in").out == "0 label files made, 2 kept as they were, 0 failed\n");
  CHECK(readFile(path) == by_hand);
  CHECK(
      label(dir, "import in --force").out ==
      "2 label files made, 0 kept as they were, 0 failed\n28 joints placed, 0 found; classes set by hand and "
      "kept: 2\nwritten into in, in/a\n");
  CHECK(readLabelFile(path).labels == mended.labels);
}

TEST_CASE("import --force drops classes of joints that are other ones now, and keeps those set by hand") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string path = dir.file("cap_boy.labels.json");
  REQUIRE(label(dir, "import .").exit_code == 0);
  const LabelFile made = readLabelFile(path);
  // As if an annotation with hands for feet had been imported before, and one candidate labelled by hand.
  LabelFile before = made;
  for (auto& [name, place] : before.joints) {
    if (name.ends_with("_foot"))
      name.replace(name.size() - 4, 4, "hand");
    else if (name.ends_with("_hand"))
      name.replace(name.size() - 4, 4, "foot");
  }
  before.labels =
      labelImage(dir.file("cap_boy.png"), dir.file("cap_boy.mask.png"), before.joints, loadTemplate("biped"))
          .labels;
  REQUIRE(before.labels != made.labels);
  const auto body =
      std::find(made.labels.begin(), made.labels.end(), JointClass::kBody) - made.labels.begin();
  before.labels[std::size_t(body)] = JointClass::kHead;
  writeLabelFile(path, before);
  REQUIRE(label(dir, "import . --force").exit_code == 0);
  LabelFile wanted = made;
  wanted.labels[std::size_t(body)] = JointClass::kHead;
  CHECK(readLabelFile(path).labels == wanted.labels);
  SECTION("of another picture none is kept") {
    before.image.sha256 = std::string(64, '0');
    writeLabelFile(path, before);
    REQUIRE(label(dir, "import . --force").exit_code == 0);
    CHECK(readLabelFile(path).labels == made.labels);
  }
}

TEST_CASE("import --force wrote over a label file that cannot be read, and lost its classes") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string path = dir.file("cap_boy.labels.json");
  REQUIRE(label(dir, "import .").exit_code == 0);
  replaceIn(path, "\"label\": \"head\"", "\"label\": \"haed\"");
  const std::string mistyped = readFile(path);
  for (const char* arguments : {"import .", "import . --force"}) {
    INFO(arguments);
    const ToolRun run = label(dir, arguments);
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err, "cap_boy.labels.json: candidates["));
    CHECK(contains(run.err, "is \"haed\", must be head, body, hand, leg or null"));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(readFile(path) == mistyped);
  }
}

TEST_CASE("a mask beside a picture was ignored by import, and by check where the label file has none") {
  const TempDir dir;
  const std::string path = importedBoy(dir);
  REQUIRE_FALSE(readLabelFile(path).mask);
  REQUIRE(label(dir, "check .").out == "no inconsistencies\n");

  fs::copy(kCharacters + "cap_boy.mask.png", dir.file("cap_boy.mask.png"));
  const ToolRun check = label(dir, "check .");
  CHECK(check.exit_code == 2);
  CHECK(
      check.err ==
      "skel-label: ./cap_boy.labels.json: mask: is null, but cap_boy.mask.png lies beside it; label it anew "
      "(skel-label import --force), or remove the mask\n");
  const bool of_skeleton = GENERATE(true, false);
  CAPTURE(of_skeleton);
  if (!of_skeleton) fs::remove(dir.file("cap_boy.skeleton.json"));
  REQUIRE(label(dir, "import . --force").exit_code == 0);
  const LabelFile labels = readLabelFile(path);
  REQUIRE(labels.mask);
  CHECK(labels.mask->file == "cap_boy.mask.png");
  CHECK(labels.mask->sha256 == sha256(readFile(dir.file("cap_boy.mask.png"))));
  CHECK(labels.isPlaced("head"));
  CHECK(label(dir, "check .").out == "no inconsistencies\n");
}

TEST_CASE("import: skeletons that skel-infer has found, of which what a person has moved counts as placed") {
  const TempDir dir;
  const SkeletonTemplate plan = loadTemplate("biped");
  for (const char* name : {"cap_boy", "box_robot", "runner"})
    fs::copy(kCharacters + name + ".png", dir.file(name + std::string(".png")));
  const auto write = [&](const std::string& name, const SkeletonTemplate& body_plan, int figure, bool edited,
                         bool all = false) {
    SkeletonFile file;
    file.image_file = name + ".png";
    file.image_sha256 = sha256(readFile(dir.file(file.image_file)));
    file.image_width = file.image_height = 600;
    file.figure.number = figure;
    file.skeleton = presetSkeleton(body_plan, {150, 50}, {450, 550});
    if (edited) file.skeleton.joints[file.skeleton.index("head")].origin = JointOrigin::kEdited;
    for (Joint& joint : file.skeleton.joints)
      if (all && !body_plan.joints[static_cast<size_t>(body_plan.find(joint.name))].derived)
        joint.origin = JointOrigin::kEdited;
    const std::string number = figure > 1 ? "-" + std::to_string(figure) : "";
    file.image_file = "../" + file.image_file;
    writeFile(dir.file("found/" + name + number + ".skeleton.json"), formatSkeletonFile(file));
  };
  write("cap_boy", plan, 1, true);
  write("cap_boy", plan, 2, true);                       // label files are of the first figure
  write("runner", loadTemplate("quadruped"), 1, false);  // of another body plan
  write("box_robot", plan, 1, true);
  fs::copy(kCharacters + "box_robot.joints.json", dir.file("box_robot.joints.json"));  // says more
  CHECK(label(dir, "import . --template biped").out ==
        "2 label files made, 0 kept as they were, 0 failed\n15 joints placed, 13 found\nwritten into .\n");
  CHECK(label(dir, "check .").exit_code == 0);
  CHECK_FALSE(fs::exists(dir.file("runner.labels.json")));
  CHECK(readLabelFile(dir.file("box_robot.labels.json")).recognized.empty());

  const LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  CHECK(labels.joints.size() == plan.joints.size());
  CHECK(labels.isPlaced("head"));
  CHECK_FALSE(labels.isPlaced("left_hand"));
  // Classes by bones that nobody has placed are no truth: not to train by, not to measure by, not finished.
  CHECK(
      std::none_of(labels.labels.begin(), labels.labels.end(), [](const auto& l) { return l.has_value(); }));
  fs::remove(dir.file("box_robot.labels.json"));
  CHECK(contains(label(dir, "stats .").out,
                 "classes finished      0    0.0 %\nwith joints           1\n  placed              1\n"));
  const ToolRun evaluated = runTool("cd '" + dir.path() + "' && skel-train evaluate .");
  CHECK(contains(evaluated.err,
                 "note: 1 drawing without a class of any candidate, left out: ./cap_boy.labels.json"));

  write("cap_boy", plan, 1, true, true);
  CHECK(contains(label(dir, "import found --force --template biped").out, "15 joints placed, 13 found\n"));
  CHECK(contains(label(dir, "stats .").out, "classes finished      1   50.0 %"));
  CHECK(label(dir, "import found").out ==
        "1 label files made, 2 kept as they were, 0 failed\n0 joints placed, 16 found\nwritten into .\n");

  fs::copy_file(kCharacters + "runner.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  const ToolRun run = label(dir, "import found --force");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "found/cap_boy.skeleton.json: cap_boy.png has changed since"));
}

TEST_CASE(
    "import: a picture that has changed stops no other, and newer joints are told, taken by force alone") {
  const TempDir dir;
  for (const char* name : {"cap_boy", "box_robot"}) {
    fs::copy(kCharacters + name + ".png", dir.file(name + std::string(".png")));
    writeSkeleton(dir, name, 300);
  }
  writeFile(dir.file("box_robot.png"), readFile(dir.file("box_robot.png")) + "x");
  ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.out, "1 label files made, 0 kept as they were, 1 failed\n1 joints placed, 13 found\n"));
  CHECK(contains(run.err, "box_robot.skeleton.json: box_robot.png has changed since"));
  fs::remove(dir.file("box_robot.skeleton.json"));

  run = label(dir, "import .");
  CHECK(run.exit_code == 0);
  CHECK(run.err == "");
  writeSkeleton(dir, "cap_boy", 310);
  run = label(dir, "import .");
  CHECK(run.exit_code == 0);
  CHECK(run.out == "0 label files made, 1 kept as they were, 0 failed\n");
  CHECK(run.err ==
        "skel-label: note: cap_boy.labels.json: kept, with other joints (elsewhere, or placed by hand) than "
        "what is to be imported; --force "
        "takes the latter, and drops joints set by hand\n");
  CHECK(label(dir, "import . --force").err == "");
  CHECK(headOf(dir.file("cap_boy.labels.json")) == 310);
}

TEST_CASE("import: of a picture that has changed other joints were told, and --force counted a failure") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  const std::string path = dir.file("cap_boy.labels.json");
  LabelFile labels = readLabelFile(path);
  const bool with_classes = GENERATE(true, false);
  CAPTURE(with_classes);
  if (!with_classes) {
    labels.labels.assign(labels.labels.size(), std::nullopt);
    writeLabelFile(path, labels);
  }
  fs::remove(dir.file("cap_boy.mask.png"));
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  ToolRun run = label(dir, "import .");
  CHECK(run.out == "0 label files made, 1 kept as they were, 0 failed\n");
  CHECK(
      contains(run.err,
               "cap_boy.labels.json: kept, but the picture has changed since it was labelled; --force makes "
               "the labels anew, and drops joints set by hand\n"));
  CHECK(readLabelFile(path).image.sha256 == labels.image.sha256);
  run = label(dir, "import . --force");
  CHECK(run.exit_code == 0);
  CHECK(run.err == "");
  CHECK(contains(run.out, "1 label files made, 0 kept as they were, 0 failed\n"));
  CHECK(readLabelFile(path).image.sha256 == sha256(readFile(dir.file("cap_boy.png"))));
}

TEST_CASE("import kept the labels of a mask that has changed without a word") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in"));
  const std::string to = GENERATE("", " -o out");
  REQUIRE(label(dir, "import in" + to).exit_code == 0);
  CHECK(label(dir, "import in" + to).err == "");
  Plane8 mask = readMask(dir.file("in/cap_boy.mask.png"));
  mask.block(0, 0, 200, 200) = 255;
  writeFile(dir.file("in/cap_boy.mask.png"), encodePng(mask));
  const ToolRun run = label(dir, "import in" + to);
  CHECK(contains(run.out, "0 label files made, 1 kept as they were, 0 failed\n"));
  CHECK(contains(run.err,
                 "cap_boy.labels.json: kept, but the mask has changed since it was labelled; "
                 "--force makes the labels anew, and drops joints set by hand\n"));
  REQUIRE(label(dir, "import in --force" + to).exit_code == 0);
  CHECK(label(dir, "import in" + to).err == "");
}

TEST_CASE("import: joints that follow from others, and roundings, were told as other joints") {
  const TempDir dir;
  const std::string path = importedBoy(dir);
  const LabelFile made = readLabelFile(path);
  const auto noteWith = [&](const std::string& joint, double by) {
    LabelFile moved = made;
    for (auto& [name, place] : moved.joints)
      if (name == joint) *place += Eigen::Vector2d(by, by);
    writeLabelFile(path, moved);
    return label(dir, "import .").err;
  };
  CHECK(noteWith("left_hand", 0.01) == "");
  CHECK(noteWith("pelvis", -5) == "");
  CHECK(contains(noteWith("left_hand", 1), "with other joints"));

  LabelFile placed = made;
  std::erase(placed.recognized, "pelvis");
  writeLabelFile(path, placed);
  CHECK(contains(label(dir, "import .").err, "with other joints"));
}

TEST_CASE("import: joints that were placed in the window gave no classes without it") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  fs::remove(dir.file("cap_boy.joints.json"));
  const std::string path = dir.file("cap_boy.labels.json");
  const LabelFile labelled = readLabelFile(path);
  LabelFile open = labelled;
  open.labels.assign(open.labels.size(), std::nullopt);
  writeLabelFile(path, open);
  const ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 0);
  CHECK(run.err == "");
  CHECK(run.out ==
        "0 label files made, 0 kept as they were, 0 failed\n"
        "classes by placed joints in 1 label files that had none\n");
  CHECK(readLabelFile(path).labels == labelled.labels);

  // Whose candidates somebody has begun to label is that person's; where no joint is placed nothing is known.
  LabelFile begun = open;
  begun.labels[0] = JointClass::kHead;
  LabelFile found = open;
  for (const auto& [name, place] : found.joints)
    if (place) found.recognized.push_back(name);
  for (const LabelFile& other : {begun, found}) {
    writeLabelFile(path, other);
    CHECK(label(dir, "import .").exit_code == 2);
    CHECK(readLabelFile(path).labels == other.labels);
  }
}

TEST_CASE("import: our own export put old joints back, and a second one stopped every import") {
  const TempDir dir;
  importedBoy(dir);
  for (const char* name : {"joints", "more"})
    REQUIRE(label(dir, "export . --coco -o " + std::string(name) + ".coco.json").exit_code == 0);
  writeSkeleton(dir, "cap_boy", 310);
  const std::string labels = dir.file("cap_boy.labels.json");
  const std::string passed_over =
      "skel-label: note: ./joints.coco.json (and 1 more): exported from label files, not imported beside "
      "what "
      "it was made of; skel-label import FILE takes it\n";
  ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 0);
  CHECK(run.out == "0 label files made, 1 kept as they were, 0 failed\n");
  CHECK(run.err.starts_with(passed_over));
  CHECK(contains(run.err,
                 "cap_boy.labels.json: kept, with other joints (elsewhere, or placed by hand) than what is "
                 "to be imported"));
  CHECK(label(dir, "import . --force").err == passed_over);
  CHECK(headOf(labels) == 310);

  CHECK(contains(label(dir, "import joints.coco.json --force").out, "1 label files made"));
  CHECK(headOf(labels) == 300);
  run = label(dir, "import cap_boy.skeleton.json");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: cap_boy.skeleton.json: is no COCO file; of other annotations name the folder\n");

  // What was set by hand in the label file is older in the export.
  fs::remove(dir.file("cap_boy.skeleton.json"));
  const std::string before = readFile(labels);
  run = label(dir, "import . --force");
  CHECK(run.exit_code == 0);
  CHECK(run.err == passed_over);
  CHECK(readFile(labels) == before);
  // Where nothing else speaks of a picture it counts.
  fs::remove(labels);
  fs::remove(dir.file("more.coco.json"));
  CHECK(contains(label(dir, "import .").out, "1 label files made"));
}

TEST_CASE("import: a joint that is missing is said, and candidates that may belong to it have no class") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("box_robot", dir.path());
  std::string joints = readFile(dir.file("cap_boy.joints.json"));
  const size_t elbow = joints.find("\"left_elbow\": [");
  REQUIRE(elbow != std::string::npos);
  joints.replace(elbow + 14, joints.find(']', elbow) - elbow - 13, "null");
  writeFile(dir.file("cap_boy.joints.json"), joints);
  const ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 0);
  const LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  const auto open = std::count(labels.labels.begin(), labels.labels.end(), std::nullopt);
  CHECK(open > 0);
  CHECK(open < static_cast<long>(labels.labels.size()) / 2);
  CHECK(run.err == "skel-label: note: ./cap_boy.labels.json: no place for left_elbow: " +
                       std::to_string(open) + " candidates have no class\n");
  CHECK(contains(label(dir, "stats .").out, "classes finished      1   50.0 %"));

  // COCO says so by a visibility of 0.
  REQUIRE(label(dir, "export . --coco -o round/coco.json").exit_code == 0);
  fs::copy(dir.file("cap_boy.png"), dir.file("round/cap_boy.png"));
  fs::copy(dir.file("box_robot.png"), dir.file("round/box_robot.png"));
  CHECK(contains(label(dir, "import round").err, "no place for left_elbow"));
  CHECK(readLabelFile(dir.file("round/cap_boy.labels.json")).labels == labels.labels);
}

TEST_CASE("import said that 0 candidates have no class") {
  const TempDir dir;
  copyCharacter("box_robot", dir.path());
  const std::string path = dir.file("box_robot.labels.json");
  replaceIn(dir.file("box_robot.joints.json"), "\"left_foot\": [", "\"left_foot\": null, \"hip\": [");
  REQUIRE(contains(label(dir, "import .").err, "candidates have no class"));
  LabelFile labels = readLabelFile(path);
  for (auto& joint_class : labels.labels)
    if (!joint_class) joint_class = JointClass::kLeg;
  writeLabelFile(path, labels);
  CHECK(label(dir, "import . --force").err ==
        "skel-label: note: ./box_robot.labels.json: no place for left_foot\n");
}

TEST_CASE("import: one picture of a COCO file that was missing kept all others from being imported") {
  const TempDir dir;
  exportTwo(dir);
  const ToolRun run = label(dir, "import round");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.out, "1 label files made, 0 kept as they were, 1 failed\n"));
  CHECK(run.err == "skel-label: round/coco.json: images[0].file_name: there is no round/box_robot.png\n");
  CHECK(fs::exists(dir.file("round/cap_boy.labels.json")));
}

TEST_CASE("import: one joints file without its picture kept all others from being imported") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::copy(kCharacters + "box_robot.joints.json", dir.file("away.joints.json"));
  const ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.out, "1 label files made, 0 kept as they were, 1 failed\n"));
  CHECK(run.err == "skel-label: ./away.joints.json: has no image beside it, away.png\n");
  CHECK(fs::exists(dir.file("cap_boy.labels.json")));
}

TEST_CASE("import: joints and outline of a COCO file were taken for a picture of another size") {
  const TempDir dir;
  exportTwo(dir);
  Image bordered(640, 640);
  bordered.rgba.setConstant(255);
  const Image robot = readImage(dir.file("in/box_robot.png"));
  for (int y = 0; y < robot.height; ++y)
    std::copy_n(robot.pixel(0, y), 4 * robot.width, bordered.pixel(20, y + 20));
  writeFile(dir.file("round/box_robot.png"), encodePng(bordered));
  const ToolRun run = label(dir, "import round");
  CHECK(run.exit_code == 2);
  CHECK(
      run.err ==
      "skel-label: round/box_robot.png: is 640x640 px, coco.json says 600x600: its joints and outline are of "
      "another picture\n");
  CHECK_FALSE(fs::exists(dir.file("round/box_robot.labels.json")));
  CHECK(fs::exists(dir.file("round/cap_boy.labels.json")));
}

TEST_CASE("import gave no candidate the class of arms that are placed, and said nothing") {
  const TempDir dir;
  for (const char* ending : {".png", ".mask.png", ".joints.json"})
    fs::copy_file(SKEL_SOURCE_DIR "/datasets/characters/sumo" + std::string(ending),
                  dir.file("sumo" + std::string(ending)));
  const ToolRun run = runTool("skel-label import '" + dir.path() + "'");
  CHECK(run.exit_code == 0);
  CHECK(
      run.err.find("sumo.labels.json: no candidate is of the class hand, though all joints of such a limb") !=
      std::string::npos);
}

TEST_CASE("import: a drawing that was renamed with its skeleton is complained of by the skeleton's name") {
  const TempDir dir;
  fs::copy(kCharacters + "cap_boy.png", dir.file("boy.png"));
  writeSkeleton(dir, "cap_boy", 300);
  fs::rename(dir.file("cap_boy.skeleton.json"), dir.file("boy.skeleton.json"));
  const ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: ./boy.skeleton.json: image.file: there is no cap_boy.png; give the picture that name "
        "again, or find its joints anew (skel-infer)\n");
}

TEST_CASE("import: a skeleton without its picture's hash writes beside no picture outside of its folder") {
  const TempDir dir;
  fs::copy(kCharacters + "cap_boy.png", dir.file("cap_boy.png"));
  SkeletonFile file;
  file.image_width = file.image_height = 600;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {150, 50}, {450, 550});
  file.image_file = "../cap_boy.png";
  writeFile(dir.file("found/cap_boy.skeleton.json"), formatSkeletonFile(file));
  const ToolRun run = label(dir, "import found");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err,
                 "found/cap_boy.skeleton.json: does not know the hash of cap_boy.png, which lies "
                 "outside of found; find its joints anew"));
  CHECK_FALSE(fs::exists(dir.file("cap_boy.labels.json")));
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
  CHECK(run.out ==
        "1 label files made, 0 kept as they were, 1 failed\n14 joints placed, 0 found\nwritten into .\n");

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

TEST_CASE("check names joints that a person has placed elsewhere than a joints file beside them") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  for (auto& [name, place] : labels.joints)
    if (name == "head" || name == "left_hand") place->x() += 1;
  writeLabelFile(dir.file("cap_boy.labels.json"), labels);
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: ./cap_boy.labels.json: joints: head, left_hand placed elsewhere than in "
        "./cap_boy.joints.json, which does not count: mend or remove that\n");
  labels.recognized = {"head", "left_hand"};
  writeLabelFile(dir.file("cap_boy.labels.json"), labels);
  CHECK(label(dir, "check .").exit_code == 0);
}

TEST_CASE("check said nothing of joints that were mended in a skeleton file after it had been imported") {
  const TempDir dir;
  importedBoy(dir);
  CHECK(label(dir, "check .").err.empty());
  writeSkeleton(dir, "cap_boy", 310);
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: ./cap_boy.labels.json: joints: head set by hand in ./cap_boy.skeleton.json, and not so "
        "here; that does not count: take it by skel-label import --force, or mend it\n");
  REQUIRE(label(dir, "import . --force").exit_code == 0);
  CHECK(label(dir, "check .").out == "no inconsistencies\n");
}

TEST_CASE("check did not see that a joint was moved in a label file that calls it recognized") {
  const TempDir dir;
  const std::string path = importedBoy(dir), skeleton = dir.file("cap_boy.skeleton.json");
  SkeletonFile found = readSkeletonFile(skeleton, loadTemplate("biped"));
  for (Joint& joint : found.skeleton.joints) joint.origin = JointOrigin::kRecognized;
  writeFile(skeleton, formatSkeletonFile(found));
  REQUIRE(label(dir, "import . --force").exit_code == 0);
  CHECK(label(dir, "check .").out == "no inconsistencies\n");
  LabelFile labels = readLabelFile(path);
  const LabelFile good = labels;
  for (auto& [name, place] : labels.joints)
    if (name == "left_hand") place->x() += 30;
  writeLabelFile(path, labels);
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: ./cap_boy.labels.json: joints: left_hand moved, but still called recognized: take it "
        "out of "
        "\"recognized\"\n");
  std::erase(labels.recognized, "left_hand");
  writeLabelFile(path, labels);
  CHECK(label(dir, "check .").exit_code == 0);

  SECTION("another net has found them all elsewhere") {
    labels = good;
    for (auto& joint : labels.joints) joint.second->x() += 3;
    writeLabelFile(path, labels);
    CHECK(label(dir, "check .").exit_code == 0);
  }
  SECTION("the skeleton was found with a joint that a person has placed") {
    writeSkeleton(dir, "cap_boy", 300);
    CHECK_FALSE(contains(label(dir, "check .").err, "recognized"));
  }
}

TEST_CASE("check did not see a joint that was moved where another one of the drawing had been placed") {
  const TempDir dir;
  const std::string path = importedBoy(dir), skeleton = dir.file("cap_boy.skeleton.json");
  // One that somebody has called right where it was found.
  std::string text = readFile(skeleton);
  const std::size_t at = text.find("\"origin\"", text.find("\"right_hand\""));
  writeFile(skeleton, text.replace(at, text.find_first_of(",}", at) - at, "\"origin\":\"edited\""));
  REQUIRE(label(dir, "import . --force").exit_code == 0);
  LabelFile labels = readLabelFile(path);
  REQUIRE_FALSE(labels.isPlaced("left_hand"));
  REQUIRE(labels.hasPlacedJoint());
  for (auto& [name, place] : labels.joints)
    if (name == "left_hand") place->x() += 30;
  writeLabelFile(path, labels);
  CHECK(contains(label(dir, "check .").err, "joints: left_hand moved, but still called recognized"));
}

TEST_CASE("joints beside a figure that lacks its legs passed check, and skel-infer said to move them") {
  const TempDir dir;
  const std::string path = importedBoy(dir);
  LabelFile labels = readLabelFile(path);
  for (auto& [name, place] : labels.joints)
    if (name == "left_foot") *place = {2, 2};
  std::erase(labels.recognized, "left_foot");
  writeLabelFile(path, labels);
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err,
                 "joints.left_foot: lies far outside of the figure; place it on the figure, or, where "
                 "that lacks a part, mend its mask (skel-label, key M)\n"));
}

TEST_CASE("check did not see a broken joints file beside a picture without labels") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  copyCharacter("box_robot", dir.path());
  writeFile(dir.file("box_robot.joints.json"), "{\"joints\": {\"head\": [1]}}");
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "skel-label: ./box_robot.joints.json: joints.head: "));
}

TEST_CASE("check did not see a mistyped or broken joints file beside labels") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  const std::string joints = dir.file("cap_boy.joints.json");
  replaceIn(joints, "\"left_hand\"", "\"left_hnad\"");
  ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-label: ./cap_boy.joints.json: joints.left_hnad: is no joint of the template biped\n");
  writeFile(joints, "{");
  run = label(dir, "check .");
  CHECK(run.exit_code == 2);
  CHECK(run.err.starts_with("skel-label: ./cap_boy.joints.json: "));
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

TEST_CASE("check says which pictures have no labels") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  copyCharacter("box_robot", dir.path());
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 0);
  CHECK(run.err == "skel-label: note: 1 of 2 pictures have no labels (box_robot.png)\n");
}

TEST_CASE("check said nothing of a picture that occurs twice") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::create_directories(dir.file("b"));
  for (const char* ending : {".png", ".mask.png", ".joints.json"})
    fs::copy(dir.file("cap_boy") + ending, dir.file("b/again") + ending);
  REQUIRE(label(dir, "import .").exit_code == 0);
  const ToolRun run = label(dir, "check .");
  CHECK(run.exit_code == 0);
  CHECK(run.out == "no inconsistencies\n");
  const std::string twins = "skel-label: note: 2 drawings are one picture (b/again.png, cap_boy.png)";
  CHECK(run.err == twins + "\n");

  const std::string path = dir.file("b/again.labels.json");
  LabelFile labels = readLabelFile(path);
  for (auto& [name, place] : labels.joints)
    if (name == "left_hand") place->y() += 40;
  writeLabelFile(path, labels);
  fs::remove(dir.file("b/again.joints.json"));
  const std::string apart = label(dir, "check .").err;
  CHECK(apart.starts_with(twins + ", their joints lie up to .0"));
  CHECK(apart.ends_with(" of the figure apart\n"));
}

TEST_CASE("an inverted mask, and that of a part of the figure, were imported and checked without a word") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const Plane8 whole = readMask(dir.file("cap_boy.mask.png"));
  CHECK(label(dir, "import . --force").err == "");
  Plane8 half = whole;
  half.bottomRows(half.rows() / 2) = 0;
  for (const Plane8& wrong : {Plane8(255 - whole), half}) {
    writeFile(dir.file("cap_boy.mask.png"), encodePng(wrong));
    const ToolRun imported = label(dir, "import . --force");
    CHECK(imported.exit_code == 0);
    CHECK(contains(imported.err, "skel-label: note: ./cap_boy.labels.json: "));
    CHECK(contains(imported.err, " of 14 joints lie outside the mask cap_boy.mask.png\n"));
    const ToolRun checked = label(dir, "check .");
    CHECK(checked.exit_code == 2);
    CHECK(contains(checked.err, "cap_boy.labels.json: mask: "));
    CHECK(contains(checked.err, " of 14 joints lie outside the mask cap_boy.mask.png\n"));
  }
}

TEST_CASE("check complained of candidates that stand in another order") {
  const TempDir dir;
  const std::string path = importedBoy(dir);
  LabelFile labels = readLabelFile(path);
  std::reverse(labels.candidates.begin(), labels.candidates.end());
  std::reverse(labels.labels.begin(), labels.labels.end());
  writeLabelFile(path, labels);
  CHECK(label(dir, "check .").out == "no inconsistencies\n");
  REQUIRE(label(dir, "export . --csv -o labels.csv").exit_code == 0);
}

TEST_CASE("import counted a broken label file twice, as kept and as failed") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("box_robot", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  writeFile(dir.file("box_robot.labels.json"), "{");
  const ToolRun run = label(dir, "import .");
  CHECK(run.exit_code == 2);
  CHECK(run.out == "0 label files made, 1 kept as they were, 1 failed\n");
}

TEST_CASE("import dropped keypoints of names of their own without a word") {
  const TempDir dir;
  exportTwo(dir);
  fs::copy(dir.file("in/box_robot.png"), dir.file("round/box_robot.png"));
  std::string text = readFile(dir.file("round/coco.json"));
  for (const auto& [ours, theirs] : {std::pair("\"left_hand\"", "\"LHand\""), {"\"head\"", "\"Top\""}})
    text.replace(text.find(ours), std::string(ours).size(), theirs);
  writeFile(dir.file("round/coco.json"), text);
  const ToolRun run = label(dir, "import round/coco.json");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err,
                 "skel-label: note: round/coco.json: not known as joints, and left out: LHand, Top\n"));
}

TEST_CASE("the labelled set of the repository has no inconsistency") {
  const ToolRun run =
      runTool("env -u DISPLAY -u WAYLAND_DISPLAY skel-label check '" SKEL_SOURCE_DIR "/datasets/characters'");
  CHECK(run.out == "no inconsistencies\n");
  CHECK(run.err == "");
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
  CHECK(contains(stats, "drawings              1\n"));
  CHECK(contains(stats, "classes finished      0    0.0 %"));
  CHECK(contains(stats, "candidates       " + std::string(6 - count.size(), ' ') + count + "\n"));

  CHECK(label(dir, "export . --csv").out == "out/labels.csv\n");
  const std::string csv = readFile(dir.file("out/labels.csv"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + static_cast<long>(labels.candidates.size()));
  CHECK(csv.starts_with(
      "file,candidate,x,y,radius,feature_x,feature_y,feature_radius,label\ncap_boy.labels.json,0,"));
  CHECK(csv.substr(0, csv.find("cap_boy.labels.json,1,")).ends_with(",\n"));  // the one without label
}

TEST_CASE("export wrote over COCO annotations of others") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  REQUIRE(label(dir, "import .").exit_code == 0);
  const std::string theirs = R"({"images": [], "annotations": []})";
  writeFile(dir.file("out/labels.coco.json"), theirs);
  const ToolRun run = label(dir, "export . --coco");
  CHECK(run.exit_code == 4);
  CHECK(run.err ==
        "skel-label: out/labels.coco.json: holds COCO annotations that skel-label has not exported; name "
        "another file by -o, or replace it by --force\n");
  CHECK(readFile(dir.file("out/labels.coco.json")) == theirs);
  CHECK(label(dir, "export . --coco --force").exit_code == 0);
  CHECK(label(dir, "export . --coco").exit_code == 0);  // over its own
}

TEST_CASE("export leaves out what check complains about and drawings of another body plan, and says so") {
  const TempDir dir;
  for (const char* name : {"cap_boy", "box_robot"}) {
    copyCharacter(name, dir.path());
    REQUIRE(label(dir, "import .").exit_code == 0);
  }
  writeFile(dir.file("box_robot.mask.png"), readFile(dir.file("cap_boy.mask.png")));
  for (const std::string format : {"csv", "coco"}) {
    INFO(format);
    const ToolRun run = label(dir, "export . -o out --" + format);
    CHECK(run.exit_code == 2);
    CHECK(run.err ==
          "skel-label: ./box_robot.labels.json: mask.file: \"box_robot.mask.png\" has changed since it was "
          "labelled; label it anew\n");
    CHECK(run.out == "out\n");
    CHECK(contains(readFile(dir.file("out")), "cap_boy"));
    CHECK_FALSE(contains(readFile(dir.file("out")), "box_robot"));
  }
  const std::string before = readFile(dir.file("out")), path = dir.file("cap_boy.labels.json");
  fs::remove(dir.file("box_robot.labels.json"));
  const LabelFile good = readLabelFile(path);
  LabelFile bad = good;
  bad.candidates[2].radius += 1;
  writeLabelFile(path, bad);
  CHECK(contains(label(dir, "export . -o out --csv").err, "candidates[2]: is not the figure's"));
  CHECK(readFile(dir.file("out")) == before);  // nothing is left to be exported

  bad = good;
  bad.joints = {{"head", Eigen::Vector2d(300, 200)}, {"tail", Eigen::Vector2d(30, 20)}};
  writeLabelFile(path, bad);
  for (const std::string format : {"csv", "coco"}) {
    INFO(format);
    const ToolRun run = label(dir, "export . -o out --template biped --" + format);
    CHECK(run.exit_code == 2);
    CHECK(run.err ==
          "skel-label: .: 1 of 1 drawings (cap_boy.labels.json) have joints of a quadruped, not of a biped: "
          "not "
          "exported; --template quadruped exports them\n");
    CHECK(label(dir, "export . -o out --template quadruped --" + format).exit_code == 0);
  }
  CHECK(contains(readFile(dir.file("out")), "\"name\": \"quadruped\""));
}

TEST_CASE("export said nothing of files beside the labels that place joints elsewhere") {
  const TempDir dir;
  importedBoy(dir);
  for (const std::string format : {"csv", "coco"}) {
    INFO(format);
    writeSkeleton(dir, "cap_boy", 300);
    CHECK(label(dir, "export . -o out --" + format).err.empty());
    writeSkeleton(dir, "cap_boy", 310);
    const ToolRun run = label(dir, "export . -o out --" + format);
    CHECK(run.exit_code == 0);
    CHECK(run.err ==
          "skel-label: note: ./cap_boy.skeleton.json places joints elsewhere than the label file beside it; "
          "the "
          "label file counts (skel-label import --force takes the skeleton's)\n");
  }
  const double x = headOf(dir.file("cap_boy.labels.json")) + 5;
  writeFile(dir.file("cap_boy.joints.json"), "{\"joints\": {\"head\": [" + std::to_string(x) + ", 100]}}");
  const ToolRun run = label(dir, "export . -o out --coco");
  CHECK(run.exit_code == 0);
  CHECK(run.err ==
        "skel-label: note: ./cap_boy.labels.json places joints elsewhere than the joints file beside it; the "
        "label file counts\n");
}

TEST_CASE("people and animals of one folder are checked, exported and imported each by its body plan") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::copy(kCharacters + "runner.png", dir.file("dog.png"));
  LabelFile labels = labelImage(dir.file("dog.png"), std::nullopt, {}, loadTemplate("biped"));
  labels.joints = {{"tail", Eigen::Vector2d(300, 300)}, {"head", Eigen::Vector2d(300, 200)}};
  writeLabelFile(dir.file("dog.labels.json"), labels);
  REQUIRE(label(dir, "import .").exit_code == 0);
  CHECK(label(dir, "check .").out == "no inconsistencies\n");
  REQUIRE(label(dir, "export . -o both.json --coco").exit_code == 0);
  const BodyPlans plans = bodyPlans("auto");
  const auto drawings = readCoco(dir.file("both.json"), plans);
  REQUIRE(drawings.size() == 2);
  CHECK(planOf(drawings[0].joints, plans).name == "biped");
  CHECK(drawings[1].joints.size() == 2);
  CHECK(planOf(drawings[1].joints, plans).name == "quadruped");
}

TEST_CASE("motion: the joints of every frame, in the order of their numbers") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("walk"), false);
  copyCharacter("box_robot", dir.file("walk"), false);
  fs::rename(dir.file("walk/cap_boy.png"), dir.file("walk/frame 10.png"));
  fs::rename(dir.file("walk/box_robot.png"), dir.file("walk/frame 9.png"));
  Image blank(60, 60);
  blank.rgba.setConstant(255);
  writeFile(dir.file("walk/frame 11.png"), encodePng(blank));
  ToolRun run = label(dir, "motion walk --frame-rate 8");
  CHECK(run.exit_code == 0);
  CHECK(run.out == "out/walk.motion.json: 3 frames, 1 without a figure\n");
  CHECK(contains(run.err, "walk/frame 11.png: "));
  const SkeletonTemplate plan = loadTemplate("biped");
  const std::string path = dir.file("out/walk.motion.json"), made = readFile(path);
  MotionFile motion = readMotionFile(path, plan);
  CHECK(motion.frame_rate == 8);
  REQUIRE(motion.frames.size() == 3);
  CHECK(motion.frames[0].image_file == "../walk/frame 9.png");
  CHECK(motion.frames[1].image_file == "../walk/frame 10.png");
  CHECK(motion.frames[1].time_s == 0.125);
  for (const auto& joint : motion.frames[1].joints) CHECK(joint);
  for (const auto& joint : motion.frames[2].joints) CHECK_FALSE(joint);

  // What a person has placed is not written over.
  CHECK(label(dir, "motion walk --frame-rate 8").exit_code == 0);
  CHECK(readFile(path) == made);
  motion.frames[0].joints[0]->origin = JointOrigin::kEdited;
  writeFile(path, formatMotionFile(motion, plan));
  run = label(dir, "motion walk --frame-rate 8");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "out/walk.motion.json: holds joints that were edited by hand"));
  CHECK(label(dir, "motion walk --frame-rate 8 --force").exit_code == 0);
  CHECK(readFile(path) == made);

  fs::remove(dir.file("walk/frame 9.png"));
  fs::remove(dir.file("walk/frame 10.png"));
  run = label(dir, "motion walk -o none.motion.json");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "skel-label: walk: shows no figure in any frame"));
  CHECK_FALSE(fs::exists(dir.file("none.motion.json")));
}

TEST_CASE("drawings whose names are not UTF-8 are imported, checked, exported, and come back") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in"));
  for (const char* ending : {".png", ".mask.png", ".joints.json"})
    fs::rename(dir.file(std::string("in/cap_boy") + ending), dir.file(std::string("in/h\xe9ros") + ending));
  CHECK(label(dir, "candidates in").exit_code == 0);
  CHECK(label(dir, "import in --force").exit_code == 0);
  CHECK(label(dir, "check in").exit_code == 0);
  CHECK(label(dir, "stats in").exit_code == 0);
  CHECK(label(dir, "export in --csv").exit_code == 0);
  CHECK(label(dir, "motion in").exit_code == 0);
  CHECK(label(dir, "export in --coco -o round/coco.json").exit_code == 0);
  fs::copy(dir.file("in/h\xe9ros.png"), dir.file("round/h\xe9ros.png"));
  CHECK(label(dir, "import round").exit_code == 0);
  CHECK(readLabelFile(dir.file("round/h\xe9ros.labels.json")).labels ==
        readLabelFile(dir.file("in/h\xe9ros.labels.json")).labels);
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

TEST_CASE("COCO: what was found goes out and comes in as found, so that nothing is measured by it") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in"), false);
  REQUIRE(label(dir, "import in").exit_code == 0);
  LabelFile labels = readLabelFile(dir.file("in/cap_boy.labels.json"));
  // Not the body, which others leave out, so that it is put between shoulders and hips.
  const std::vector<std::string> found = {"body", "left_hand", "right_foot"};
  labels.recognized = found;
  writeLabelFile(dir.file("in/cap_boy.labels.json"), labels);
  REQUIRE(label(dir, "export in --coco -o round/coco.json").exit_code == 0);
  fs::copy(dir.file("in/cap_boy.png"), dir.file("round/cap_boy.png"));
  CHECK(contains(label(dir, "import round").out, "11 joints placed, 3 found\n"));
  const LabelFile back = readLabelFile(dir.file("round/cap_boy.labels.json"));
  CHECK(back.joints.size() == labels.joints.size());
  for (const auto& [name, place] : back.joints)
    CHECK(back.isPlaced(name) == (std::find(found.begin(), found.end(), name) == found.end()));
}

TEST_CASE("COCO: an outline that was found came back as a mask, by which silhouettes were measured") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("in"), false);
  REQUIRE(label(dir, "import in").exit_code == 0);
  REQUIRE(label(dir, "export in --coco -o round/coco.json").exit_code == 0);
  fs::copy(dir.file("in/cap_boy.png"), dir.file("round/cap_boy.png"));
  CHECK(label(dir, "import round").exit_code == 0);
  CHECK_FALSE(fs::exists(dir.file("round/cap_boy.mask.png")));
  const LabelFile back = readLabelFile(dir.file("round/cap_boy.labels.json"));
  CHECK_FALSE(back.mask);
  CHECK(back.labels == readLabelFile(dir.file("in/cap_boy.labels.json")).labels);
}

TEST_CASE("the card of the labelled set tells its counts") {
  const std::string card = readFile(SKEL_SOURCE_DIR "/datasets/README.md");
  const LabelledSet set = readLabelledSet(kCharacters);
  const auto grouped = [](int count) {
    std::string text = std::to_string(count);
    return text.size() > 3 ? text.insert(text.size() - 3, ",") : text;
  };
  CHECK(contains(card, "| characters | " + std::to_string(set.characters.size()) + ", "));
  CHECK(contains(card, "| candidates | " + grouped(set.sampleCount()) + ", "));
  for (size_t c = 0; c < kJointClassCount; ++c) {
    const int count = set.classCounts()[c];
    char text[64];
    std::snprintf(text, sizeof text, "%s %s (%.1f %%)", kJointClassNames[c], grouped(count).c_str(),
                  100.0 * count / set.sampleCount());
    CHECK(contains(card, text));
  }
}
