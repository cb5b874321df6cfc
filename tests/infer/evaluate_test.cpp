// skel-infer evaluate against the scorer that comes with the real drawings. Both need those drawings.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skeleton/template.h"
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

// With its joints, without its mask.
void copyCapBoy(const skel::TempDir& dir) {
  for (const char* end : {".png", ".joints.json"})
    std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                               dir.file(std::string("cap_boy") + end));
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
                                    "' --infer skel-infer --given-mask --out '" + dir.path() + "'");
  const auto ours = skel::runTool("skel-infer evaluate '" + drawings + "' --given-mask --jobs 0");
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
  const auto done = skel::runTool("skel-infer evaluate '" + folder + "' --given-mask --overlays '" +
                                  dir.path() + "/pictures' --json '" + dir.path() + "/figures.json'");
  CAPTURE(done.out);
  REQUIRE(done.exit_code == 0);
  CHECK(std::filesystem::exists(dir.path() + "/pictures/cap_boy.png"));
  const skel::JsonDocument figures = skel::JsonDocument::readFile(dir.path() + "/figures.json");
  CHECK(figures.root().at("characters").at("cap_boy").at("pck10").asNumber() == 1);
  CHECK_FALSE(figures.root().at("characters").at("cap_boy").at("worst_joint").asString().empty());
}

TEST_CASE("joints that were taken over from what is measured gave it full marks without a word") {
  const skel::TempDir dir;
  const std::string drawing = dir.file("cap_boy.png"), mask = dir.file("cap_boy.mask.png");
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.png", drawing);
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.mask.png", mask);
  REQUIRE(skel::runTool("skel-infer '" + drawing + "' --formats json -o '" + dir.path() + "'").exit_code ==
          0);
  std::string text = skel::readFile(dir.file("cap_boy.skeleton.json"));
  for (const std::string found = "\"recognized\""; text.find(found) != std::string::npos;)
    text.replace(text.find(found), found.size(), "\"edited\"");
  skel::writeFile(dir.file("cap_boy.skeleton.json"), text);
  REQUIRE(skel::runTool("skel-label import '" + dir.path() + "'").exit_code == 0);
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --given-mask");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Catch::Matchers::Contains("joints are annotated exactly where they are found now"));
}

TEST_CASE("evaluate refuses a joint that lies in no picture: its error was no number of JSON") {
  const skel::TempDir dir;
  for (const char* end : {".png", ".mask.png"})
    std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                               dir.file(std::string("cap_boy") + end));
  skel::writeFile(dir.file("cap_boy.joints.json"),
                  R"({"joints": {"head": [1e308, 0], "body": [-1e308, 0]}})");
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "'");
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("cap_boy.joints.json: joints.head: lies in no picture") != std::string::npos);
}

TEST_CASE("of a folder and a file of one name evaluate measured one without a word") {
  const skel::TempDir dir;
  std::filesystem::create_directories(dir.file("set/boy"));
  for (const char* end : {"png", "joints.json"}) {
    const std::string from = std::string(SKEL_DATASETS "/characters/cap_boy.") + end;
    std::filesystem::copy_file(from, dir.file(std::string("set/boy.") + end));
    std::filesystem::copy_file(
        from, dir.file(std::string("set/boy/") + (end == std::string("png") ? "image.png" : end)));
  }
  const auto run = skel::runTool("skel-infer evaluate '" + dir.file("set") + "'");
  CHECK(run.exit_code == 2);
  CHECK(
      run.err.find("set/boy: is one drawing as a folder with an image.png and another as a file beside it") !=
      std::string::npos);
}

TEST_CASE("a drawing that lies right in the measured folder had no name") {
  const skel::TempDir dir;
  const std::string set = dir.file("boy");
  std::filesystem::create_directories(set);
  for (const std::string end : {"png", "mask.png", "joints.json"})
    std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy." + end,
                               set + "/" + (end == "png" ? "image.png" : end));
  for (const std::string& named : {set, set + "/", set + "/."}) {
    const auto run = skel::runTool("skel-infer evaluate '" + named + "' --given-mask --overlays '" +
                                   dir.file("overlays") + "' --json '" + dir.file("figures.json") + "'");
    CAPTURE(named, run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("\nboy  ") != std::string::npos);
    CHECK(std::filesystem::remove(dir.file("overlays/boy.png")));
    const skel::JsonDocument figures = skel::JsonDocument::readFile(dir.file("figures.json"));
    CHECK(figures.root().at("characters").keys() == std::vector<std::string>{"boy"});
  }
  std::filesystem::create_directories(set + "/boy");
  std::filesystem::copy_file(set + "/image.png", set + "/boy/image.png");
  const auto run = skel::runTool("skel-infer evaluate '" + set + "'");
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("and boy in it another of that name") != std::string::npos);
}

TEST_CASE("evaluate --opaque said nothing where it leaves nothing to measure") {
  const skel::TempDir dir;
  copyCapBoy(dir);
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --opaque");
  CHECK(run.exit_code == 2);
  CHECK(run.out.empty());
  CHECK(run.err == "skel-infer: " + dir.path() +
                       ": holds no annotated drawing whose silhouette has to be found (--opaque): nothing to "
                       "measure\n");
}

TEST_CASE("evaluate passed over joints and members of a joints file that it does not know") {
  const skel::TempDir dir;
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.png", dir.file("boy.png"));
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.mask.png"));
  const std::vector<std::pair<std::string, std::string>> files = {
      {R"({"joints": {"head": [301, 198], "left_hant": [1, 2]}})",
       "boy.joints.json: joints.left_hant: is no joint of the template biped\n"},
      {R"({"joints": {"head": [301, 198]}, "veiw": "side"})",
       "boy.joints.json: has the unknown key \"veiw\""}};
  for (const auto& [text, reason] : files) {
    skel::writeFile(dir.file("boy.joints.json"), text);
    for (const std::string tool : {"skel-infer", "skel-train"}) {
      const auto run = skel::runTool(tool + " evaluate '" + dir.path() + "'");
      CAPTURE(tool, run.err);
      CHECK(run.exit_code == 2);
      CHECK(run.err.find(reason) != std::string::npos);
    }
  }
}

TEST_CASE("evaluate measures by the joints of label files that a person has placed, by no others") {
  const skel::TempDir dir;
  const std::string set = dir.file("set");
  std::filesystem::create_directories(set);
  for (const char* name : {"cap_boy", "runner"})
    std::filesystem::copy_file(SKEL_DATASETS "/characters/" + std::string(name) + ".png",
                               set + "/" + name + ".png");
  const std::string image = set + "/cap_boy.png", label_file = set + "/cap_boy.labels.json";
  const skel::NamedJoints joints = {
      {"head", {{301, 198}}}, {"left_hand", {{20, 20}}}, {"right_hand", {{5, 5}}}};
  skel::LabelFile labels = skel::labelImage(image, {}, joints, skel::loadTemplate("biped"));
  labels.recognized = {"right_hand"};
  skel::writeLabelFile(label_file, labels);
  const auto figures_of = [&](const std::string& name) {
    const auto run = skel::runTool("skel-infer evaluate '" + set + "' --json '" + dir.file(name) + "'");
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    return skel::JsonDocument::readFile(dir.file(name));
  };
  const skel::JsonDocument figures = figures_of("figures.json");
  REQUIRE(figures.root().at("characters").keys().size() == 1);
  const skel::JsonValue boy = figures.root().at("characters").at("cap_boy");
  CHECK(boy.at("pck10").asNumber() == 0.5);  // the head, not the hand
  CHECK(boy.at("worst_joint").asString() == "left_hand");

  labels.recognized = {"head", "left_hand", "right_hand"};
  skel::writeLabelFile(label_file, labels);
  const auto run = skel::runTool("skel-infer evaluate '" + set + "'");
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("of which a person has placed a joint") != std::string::npos);
}

TEST_CASE("evaluate ignored a mask beside a label file that has none") {
  const skel::TempDir dir;
  const std::string image = dir.file("cap_boy.png"), label_file = dir.file("cap_boy.labels.json");
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.png", image);
  skel::writeLabelFile(label_file,
                       skel::labelImage(image, {}, {{"head", {{301, 198}}}}, skel::loadTemplate("biped")));
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("cap_boy.mask.png"));
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --given-mask");
  CAPTURE(run.out);
  CHECK(run.exit_code == 0);
  CHECK(run.err.empty());
  CHECK(run.out.find("silhouette IoU 1.000") != std::string::npos);
}

TEST_CASE("evaluate measures joints without a mask, and what there is nothing to measure by is no figure") {
  const skel::TempDir dir;
  copyCapBoy(dir);
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --given-mask --json '" +
                                 dir.file("figures.json") + "'");
  CAPTURE(run.out, run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(run.err ==
        "skel-infer: note: cap_boy: no mask to hand over (--given-mask), so the figure was found\n");
  CHECK(run.out.find("silhouette IoU -, >= .9 in -  |") != std::string::npos);
  CHECK(run.out.find("area under ROC -, calibration error 0.") != std::string::npos);
  const skel::JsonDocument figures = skel::JsonDocument::readFile(dir.file("figures.json"));
  CHECK(figures.root().at("characters").at("cap_boy").at("pck10").asNumber() == 1);
  CHECK(figures.root().at("characters").at("cap_boy").at("iou").isNull());
  for (const char* key : {"iou", "iou90", "inside", "confidence_auc"})
    CHECK(figures.root().at("mean").at(key).isNull());
}

TEST_CASE("evaluate printed the head of an empty table where no joints are annotated") {
  const skel::TempDir dir;
  skel::writeFile(dir.file("boy/image.png"), skel::readFile(SKEL_DATASETS "/characters/cap_boy.png"));
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "'");
  CHECK(run.exit_code == 0);
  CHECK(run.err == "skel-infer: note: no joints are annotated in " + dir.path() + ", so none are measured\n");
  CHECK(run.out.starts_with("hard case boy: confidence "));
}

TEST_CASE("evaluate --json wrote over COCO annotations of others") {
  const skel::TempDir dir;
  copyCapBoy(dir);
  const std::string theirs = R"({"images": [], "annotations": []})", path = dir.file("coco.json");
  skel::writeFile(path, theirs);
  const std::string evaluate = "evaluate '" + dir.path() + "' --json '" + path + "'";
  for (const std::string tool : {"skel-infer ", "skel-train "}) {
    const auto run = skel::runTool(tool + evaluate);
    CHECK(run.exit_code == 4);
    CHECK(run.err.ends_with(path + ": holds COCO annotations that skel-label has not exported; name another "
                                   "file by --json\n"));
    CHECK(skel::readFile(path) == theirs);
  }
}

TEST_CASE("evaluate goes on after a drawing that cannot be read, and says so") {
  const skel::TempDir dir;
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    for (const std::string name : {"good", "broken"})
      std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                                 dir.file(name + end));
  std::filesystem::resize_file(dir.file("broken.png"), 5000);
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --given-mask");
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("broken.png: ") != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  CHECK(run.out.find("mean over 1 characters") != std::string::npos);
}

TEST_CASE("evaluate took joints beside a .png alone, and no tool those beside a picture in capitals") {
  const skel::TempDir dir;
  const std::string robot = SKEL_DATASETS "/characters/box_robot";
  for (const char* name : {"a.jpg", "b.JPG", "c.PNG", "d/image.Jpeg"}) {
    const std::filesystem::path picture = dir.file(name);
    std::filesystem::create_directories(picture.parent_path());
    std::filesystem::copy_file(robot + ".png", picture);
    const bool own = picture.stem() == "image";
    std::filesystem::copy_file(robot + ".joints.json",
                               own ? picture.parent_path() / "joints.json"
                                   : std::filesystem::path(picture).replace_extension(".joints.json"));
  }
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --jobs 1");
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.out.find("mean over 4 characters") != std::string::npos);
  const auto over =
      skel::runTool("skel-infer evaluate '" + dir.path() + "' --json '" + dir.file("b.JPG") + "'");
  CHECK(over.exit_code != 0);
  CHECK(skel::readFile(dir.file("b.JPG")) == skel::readFile(robot + ".png"));

  std::filesystem::remove(dir.file("a.jpg"));
  const auto without = skel::runTool("skel-infer evaluate '" + dir.path() + "' --jobs 1");
  CHECK(without.exit_code == 2);
  CHECK(without.err.find("a.joints.json: has no image beside it, a.png") != std::string::npos);
  CHECK(without.out.find("mean over 3 characters") != std::string::npos);
}

TEST_CASE(
    "evaluate wrote its figures over the joints, the mask or the picture of a drawing that it measures") {
  const skel::TempDir dir;
  for (const std::string name : {"cap_boy", "knight"})
    for (const char* end : {".png", ".mask.png", ".joints.json"})
      std::filesystem::copy_file(SKEL_DATASETS "/characters/" + name + end, dir.file(name + end));
  std::filesystem::create_directory(dir.file("f"));
  std::filesystem::copy_file(dir.file("knight.png"), dir.file("f/image.png"));
  skel::writeFile(dir.file("f-image.png"), "");
  std::filesystem::rename(dir.file("knight.png"), dir.file("sole.png"));
  std::filesystem::rename(dir.file("knight.joints.json"), dir.file("sole.joints.json"));
  std::filesystem::rename(dir.file("knight.mask.png"), dir.file("sole.mask.png"));
  for (const char* output : {"sole.joints.json", "sole.mask.png", "sole.png", "cap_boy.joints.json",
                             "f/image.png", "--overlays"}) {
    const bool pictures = output == std::string("--overlays");
    const std::string kept = dir.file(pictures ? "sole.png" : output), before = skel::readFile(kept);
    const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' " +
                                   (pictures ? "--overlays '" + dir.path() : "--json '" + kept) + "'");
    CAPTURE(output, run.out, run.err);
    CHECK(run.exit_code == 1);
    CHECK(run.out.empty());
    CHECK(run.err.find("would be written over, but it is an input") != std::string::npos);
    CHECK(skel::readFile(kept) == before);
  }
}

TEST_CASE("evaluate measured joints that lie outside of the picture without a word") {
  const skel::TempDir dir;
  for (const char* end : {".png", ".mask.png"})
    std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/cap_boy") + end,
                               dir.file(std::string("cap_boy") + end));
  skel::writeFile(dir.file("cap_boy.joints.json"),
                  R"({"joints": {"head": [100, 60], "left_hand": [9000, 50]}})");
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "'");
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.err.find("outside of the picture, measured as they are: cap_boy (left_hand)") !=
        std::string::npos);
}

TEST_CASE("evaluate leaves out a picture that has changed since its joints were placed, and says so") {
  const skel::TempDir dir;
  for (const char* name : {"cap_boy", "ninja"})
    for (const char* end : {".png", ".mask.png", ".labels.json"})
      std::filesystem::copy_file(std::string(SKEL_DATASETS "/characters/") + name + end,
                                 dir.file(std::string(name) + end));
  const std::string evaluate = "skel-infer evaluate '" + dir.path() + "' --given-mask";
  CHECK(skel::runTool(evaluate).exit_code == 0);
  const std::string picture = dir.file("ninja.png");
  skel::writeFile(picture, skel::readFile(picture) + "x");
  const auto run = skel::runTool(evaluate);
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 2);
  CHECK(run.err == "skel-infer: " + dir.file("ninja.labels.json") +
                       ": image.file: \"ninja.png\" has changed since it was labelled; label it anew\n");
  CHECK(run.out.find("mean over 1 characters") != std::string::npos);
}

TEST_CASE("evaluate measures by what a person has placed in a label file, not by the joints file beside it") {
  const skel::TempDir dir;
  for (const std::string stem : {"cap_boy.", "boy/"}) {
    const auto file = [&](const char* name) {
      return dir.file(stem + (stem == "boy/" && name == std::string("png") ? "image.png" : name));
    };
    std::filesystem::create_directories(dir.file("boy"));
    for (const char* end : {"png", "mask.png", "joints.json"})
      std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy." + std::string(end), file(end));
    skel::LabelFile labels =
        skel::labelImage(file("png"), file("mask.png"), skel::readJointsFile(file("joints.json")),
                         skel::loadTemplate("biped"));
    for (auto& [name, place] : labels.joints)
      if (name == "left_hand") place = {{5, 5}};
    skel::writeLabelFile(skel::labelFileFor(file("png")), labels);
  }
  const std::string evaluate =
      "skel-infer evaluate '" + dir.path() + "' --given-mask --json '" + dir.file("figures.json") + "'";
  auto run = skel::runTool(evaluate);
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.err ==
        "skel-infer: note: " + dir.file("boy/image.labels.json") +
            " (and 1 more) places joints elsewhere than the joints file beside it; the label file counts\n");
  const skel::JsonDocument figures = skel::JsonDocument::readFile(dir.file("figures.json"));
  for (const char* name : {"boy", "cap_boy"})
    CHECK(figures.root().at("characters").at(name).at("worst_joint").asString() == "left_hand");

  skel::writeFile(dir.file("cap_boy.mask.png"), skel::readFile(dir.file("cap_boy.mask.png")) + "x");
  std::filesystem::remove(dir.file("boy/joints.json"));
  run = skel::runTool(evaluate);
  CAPTURE(run.out, run.err);
  CHECK(run.exit_code == 2);
  CHECK(run.err ==
        "skel-infer: " + dir.file("cap_boy.labels.json") +
            ": mask.file: \"cap_boy.mask.png\" has changed since it was labelled; label it anew\n");
  CHECK(run.out.find("mean over 1 characters") != std::string::npos);
}

TEST_CASE("evaluate measures no animal as a biped, and says by which template it is measured") {
  const skel::TempDir dir;
  for (const char* name : {"characters/cap_boy", "animals/walking_dog"})
    for (const char* end : {".png", ".mask.png", ".joints.json"})
      std::filesystem::copy_file(std::string(SKEL_DATASETS "/") + name + end,
                                 dir.file(std::filesystem::path(name).filename().string() + end));
  const auto says = [&](const std::string& options, const std::string& line, const std::string& measured) {
    const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "' --given-mask" + options);
    CAPTURE(run.out, run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err == "skel-infer: " + dir.path() + ": " + line + "\n");
    CHECK(run.out.find("mean over 1 characters") != std::string::npos);
    CHECK(run.out.find("\n" + measured + " ") != std::string::npos);
  };
  says("",
       "1 of 2 drawings (walking_dog) have joints of a quadruped, not of a biped: not measured; --template "
       "quadruped measures them",
       "cap_boy");
  says(" --template quadruped",
       "1 of 2 drawings (cap_boy) have joints of a biped, not of a quadruped: not measured; --template biped "
       "measures them",
       "walking_dog");
}

TEST_CASE("evaluate offered --template auto, which it refuses") {
  const skel::ToolRun help = skel::runTool("skel-infer evaluate --help");
  CHECK(help.exit_code == 0);
  CHECK(help.out.find("biped, quadruped, or a .json file") != std::string::npos);
  CHECK(help.out.find("auto") == std::string::npos);
}

TEST_CASE("evaluate said nothing of joints that were mended in a skeleton file after it had been imported") {
  const skel::TempDir dir;
  std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy.png", dir.file("cap_boy.png"));
  const std::string infer =
                        "skel-infer '" + dir.file("cap_boy.png") + "' --formats json -o '" + dir.path() + "'",
                    evaluate = "skel-infer evaluate '" + dir.path() + "'";
  REQUIRE(skel::runTool(infer).exit_code == 0);
  const std::string path = dir.file("cap_boy.skeleton.json");
  skel::SkeletonFile file = skel::readSkeletonFile(path, skel::loadTemplate("biped"));
  for (skel::Joint& joint : file.skeleton.joints) joint.origin = skel::JointOrigin::kEdited;
  skel::writeFile(path, skel::formatSkeletonFile(file));
  skel::NamedJoints joints;
  for (const skel::Joint& joint : file.skeleton.joints) joints.emplace_back(joint.name, joint.image);
  skel::writeLabelFile(
      dir.file("cap_boy.labels.json"),
      skel::labelImage(dir.file("cap_boy.png"), std::nullopt, joints, skel::loadTemplate("biped")));
  const std::string taken_over = skel::runTool(evaluate).err;
  CHECK(
      taken_over.starts_with("skel-infer: note: 14 of 14 joints are annotated exactly where they are found"));
  file.skeleton.joints[std::size_t(file.skeleton.index("left_foot"))].image.y() -= 50;
  skel::writeFile(path, skel::formatSkeletonFile(file));
  const auto run = skel::runTool(evaluate);
  CHECK(run.exit_code == 0);
  CHECK(run.err == "skel-infer: note: " + path +
                       " places joints elsewhere than the label file beside it; the label file counts "
                       "(skel-label import --force takes the skeleton's)\n" +
                       taken_over);
}

TEST_CASE("evaluate says how far joints lie apart that two have placed in one picture, and what has none") {
  const skel::TempDir dir;
  copyCapBoy(dir);
  std::filesystem::copy_file(SKEL_DATASETS "/characters/ninja.png", dir.file("ninja.png"));
  std::filesystem::copy_file(dir.file("cap_boy.png"), dir.file("again.png"));
  skel::NamedJoints joints = skel::readJointsFile(dir.file("cap_boy.joints.json"));
  std::string text = "{\"joints\": {";
  for (const auto& [name, place] : joints)
    if (place)
      text += (text.ends_with("{") ? "\"" : ", \"") + name + "\": [" + std::to_string(place->x()) + ", " +
              std::to_string(place->y() + (name == "left_hand" ? 60 : 0)) + "]";
  skel::writeFile(dir.file("again.joints.json"), text + "}}");
  const auto run = skel::runTool("skel-infer evaluate '" + dir.path() + "'");
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.err.find("note: 2 drawings are one picture (again, cap_boy), their joints lie up to .1") !=
        std::string::npos);
  CHECK(run.err.find("note: 1 of 3 pictures have no joint that a person has placed (ninja.png)\n") !=
        std::string::npos);
}
