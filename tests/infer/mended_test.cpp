// What a person has mended is taken up by the next run by itself, and what skel wrote is not taken for it.
#include <chrono>
#include <filesystem>
#include <map>

#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/import/read_character.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skeleton/template.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// A drawing without annotations, in that folder as boy.png.
void drawBoy(const TempDir& dir) { writeFile(dir.file("boy.png"), readFile(kDrawing)); }

constexpr const char* kSkeleton = "out/boy.skeleton.json";

// Where the skeleton file has that joint.
std::vector<double> placeIn(const TempDir& dir, const std::string& name,
                            const std::string& file = kSkeleton) {
  const JsonDocument document = JsonDocument::readFile(dir.file(file));
  for (const JsonValue& joint : document.root().at("joints").items())
    if (joint.at("name").asString() == name) return joint.at("image").asNumbers(2);
  return {};
}

void moveInFile(const TempDir& dir, const std::string& name, const std::string& x,
                const std::string& file = kSkeleton) {
  std::string text = readFile(dir.file(file));
  const size_t start = text.find("\"image\":[", text.find("\"name\":\"" + name)) + 9;
  text.replace(start, text.find(',', start) - start, x);
  writeFile(dir.file(file), text);
}

// All files below the folder, with what is in them.
std::map<std::string, std::string> contentOf(const TempDir& dir, const std::string& folder) {
  std::map<std::string, std::string> content;
  for (const std::string& file : filesBelow(dir.file(folder))) content[file] = readFile(file);
  return content;
}

// As skel-label saves them: one joint placed, one that was found.
void placeInLabels(const TempDir& dir, const Eigen::Vector2d& left_hand, const std::string& mask = "") {
  LabelFile labels;
  const std::string image = readFile(dir.file("boy.png"));
  labels.image = {"boy.png", sha256(image)};
  if (!mask.empty()) labels.mask = LabelFile::Source{mask, sha256(readFile(dir.file(mask)))};
  labels.image_width = labels.image_height = 600;
  labels.grid_width = labels.grid_height = kWorkingGridSize;
  labels.joints = {{"left_hand", left_hand}, {"right_hand", Eigen::Vector2d(100, 300)}};
  labels.recognized = {"right_hand"};
  writeLabelFile(dir.file("boy.labels.json"), labels);
}

// As undo leaves them.
void takeBackInLabels(const TempDir& dir) {
  const std::string path = dir.file("boy.labels.json");
  LabelFile labels = readLabelFile(path);
  for (auto& [name, place] : labels.joints)
    if (labels.isPlaced(name)) place.reset();
  writeLabelFile(path, labels);
}

// Another drawing under the same name.
void takeAgain(const TempDir& dir, const std::string& character) {
  writeFile(dir.file("boy.png"), readFile(SKEL_DATASETS "/characters/" + character + ".png"));
}

// The boy cut out of his paper.
void drawSprite(const TempDir& dir) {
  Image boy = readImage(kDrawing);
  const Plane8 mask = extractSilhouette(boy).mask;
  for (int y = 0; y < boy.height; ++y)
    for (int x = 0; x < boy.width; ++x) boy.pixel(x, y)[3] = mask(y, x);
  writeFile(dir.file("boy.png"), encodePng(boy));
}

// Three times are none.
void recolor(const TempDir& dir) {
  Image sprite = readImage(dir.file("boy.png"));
  for (Eigen::Index p = 0; p < sprite.rgba.rows(); ++p) {
    const auto red = sprite.rgba(p, 0);
    sprite.rgba(p, 0) = sprite.rgba(p, 1);
    sprite.rgba(p, 1) = sprite.rgba(p, 2);
    sprite.rgba(p, 2) = red;
  }
  writeFile(dir.file("boy.png"), encodePng(sprite));
}

void cutOffFeet(const TempDir& dir) {
  Image sprite = readImage(dir.file("boy.png"));
  for (int y = sprite.height * 9 / 10; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width / 2; ++x) sprite.pixel(x, y)[3] = 0;
  writeFile(dir.file("boy.png"), encodePng(sprite));
}

// The left leg, of which no limb is left; returns the file.
std::string paintOverLeg(const TempDir& dir) {
  Image layers = readImage(dir.file("out/boy.layers.png"));
  for (Eigen::Index p = 0; p < layers.rgba.rows(); ++p)
    if (layers.rgba(p, 0) == 40 && layers.rgba(p, 1) == 170) layers.rgba.row(p) << 150, 150, 150, 255;
  const std::string painted = encodePng(layers);
  writeFile(dir.file("out/boy.layers.png"), painted);
  return painted;
}

// The figure's silhouette with a hat that the picture does not have.
std::string paintedMask(const TempDir& dir) {
  Plane8 mask = extractSilhouette(readImage(dir.file("boy.png"))).mask;
  int top = 0;
  while ((mask.row(top) == 0).all()) ++top;
  int x = 0;
  while (mask(top, x) == 0) ++x;
  mask.block(top - 12, x - 10, 20, 20) = 255;
  return encodePng(mask);
}

constexpr const char* kEarlier = "mended for an earlier picture of this name, not taken up for this one: ";
constexpr const char* kTakenUp = "made by hand and taken up: ";

}  // namespace

TEST_CASE("a joint that was moved in the skeleton file stays where it was put, and one line says so") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  const auto before = placeIn(dir, "left_hand");
  moveInFile(dir, "left_hand", "420.5");
  for (int time = 0; time < 2; ++time) {
    const ToolRun again = infer(dir, "boy.png");
    CHECK(again.exit_code == 0);
    CHECK_THAT(again.err, Contains(kTakenUp + std::string("1 joint (out/boy.skeleton.json)\n")));
    CHECK(placeIn(dir, "left_hand") == std::vector<double>{420.5, before[1]});
  }
  SECTION("--force loses it") {
    const ToolRun run = infer(dir, "boy.png --force");
    CHECK(run.err.find("by hand") == run.err.npos);
    CHECK(placeIn(dir, "left_hand") == before);
  }
}

TEST_CASE(
    "a photo that was taken again is rigged from scratch, and its mended skeleton is kept under another "
    "name") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  for (const std::string kept : {"boy.skeleton.old.json", "boy.skeleton.old-2.json"}) {
    moveInFile(dir, "left_hand", "300.5");
    const std::string mended = readFile(dir.file("out/boy.skeleton.json"));
    takeAgain(dir, kept == "boy.skeleton.old.json" ? "clown" : "cap_boy");
    REQUIRE(infer(dir, "boy.png -o fresh").exit_code == 0);
    const ToolRun run = infer(dir, "boy.png");
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Contains(kEarlier + std::string("boy.skeleton.json (now ") + kept +
                                 "; --skeleton out/" + kept + " takes it up)\n"));
    CHECK(readFile(dir.file("out/" + kept)) == mended);
    for (const char* result : {"boy.skeleton.json", "boy.glb"})
      CHECK(readFile(dir.file(std::string("out/") + result)) ==
            readFile(dir.file(std::string("fresh/") + result)));
    CHECK(infer(dir, "boy.png").err.find("earlier picture") == std::string::npos);
  }
}

TEST_CASE(
    "a sprite in other colours lost its mended joints and painted limbs, though its outline was the same") {
  const TempDir dir;
  drawSprite(dir);
  const std::string call = "boy.png --formats glb,json,layers";
  REQUIRE(infer(dir, call).exit_code == 0);
  moveInFile(dir, "left_hand", "420.5");
  const std::string painted = paintOverLeg(dir), mended = readFile(dir.file(kSkeleton));
  recolor(dir);
  SECTION("now they stay") {
    for (int time = 0; time < 2; ++time) {
      const ToolRun run = infer(dir, call);
      CHECK(run.exit_code == 0);
      CHECK_THAT(run.err, Contains(kTakenUp + std::string("1 joint (out/boy.skeleton.json), limbs "
                                                          "(out/boy.layers.png)\n")));
      CHECK(run.err.find("look at") == std::string::npos);
      CHECK(placeIn(dir, "left_hand").front() == 420.5);
      CHECK(readFile(dir.file("out/boy.layers.png")) == painted);
    }
  }
  SECTION("of another outline they are kept, and the line says how to take the joints up") {
    cutOffFeet(dir);
    const ToolRun run = infer(dir, call);
    CHECK_THAT(run.err,
               Contains(kEarlier + std::string("boy.skeleton.json (now boy.skeleton.old.json; --skeleton "
                                               "out/boy.skeleton.old.json takes it up)\n")));
    CHECK_THAT(run.err, Contains("boy.layers.png (now boy.old.layers.png), as the picture has changed\n"));
    CHECK(readFile(dir.file("out/boy.skeleton.old.json")) == mended);
  }
}

TEST_CASE("a mended skeleton file that somebody has broken was passed over without a word") {
  const TempDir dir;
  drawSprite(dir);
  REQUIRE(infer(dir, "boy.png --formats json -o out").exit_code == 0);
  moveInFile(dir, "left_hand", "420.5");
  std::string broken = readFile(dir.file(kSkeleton));
  broken.erase(broken.find(','), 1);
  writeFile(dir.file(kSkeleton), broken);
  const ToolRun run = infer(dir, "boy.png --formats glb -o elsewhere");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("out/boy.skeleton.json: is not JSON"));
  CHECK_FALSE(fs::exists(dir.file("elsewhere/boy.glb")));
  CHECK(readFile(dir.file(kSkeleton)) == broken);
  // What is not ours is nothing to us.
  writeFile(dir.file(kSkeleton), "bones");
  CHECK(infer(dir, "boy.png --formats glb -o elsewhere").exit_code == 0);
}

TEST_CASE("results that were moved lost what was mended when the sprite got other colours after that") {
  const TempDir dir;
  drawSprite(dir);
  const std::string call = "boy.png --formats glb,json,layers";
  REQUIRE(infer(dir, call).exit_code == 0);
  moveInFile(dir, "left_hand", "420.5");
  paintOverLeg(dir);
  // The path in the skeleton file leads nowhere from here.
  fs::create_directories(dir.file("art/sprites"));
  fs::rename(dir.file("out"), dir.file("art/sprites/out"));
  fs::rename(dir.file("boy.png"), dir.file("art/sprites/boy.png"));
  std::string skeleton = readFile(dir.file("art/sprites/out/boy.skeleton.json"));
  const std::string there = "../boy.png";
  REQUIRE(skeleton.find(there) != std::string::npos);
  skeleton.replace(skeleton.find(there), there.size(), "../of/yore/boy.png");
  writeFile(dir.file("art/sprites/out/boy.skeleton.json"), skeleton);
  Image sprite = readImage(dir.file("art/sprites/boy.png"));
  for (Eigen::Index p = 0; p < sprite.rgba.rows(); ++p) std::swap(sprite.rgba(p, 0), sprite.rgba(p, 2));
  writeFile(dir.file("art/sprites/boy.png"), encodePng(sprite));
  const ToolRun run = infer(dir, "art/sprites/boy.png --formats glb -o elsewhere");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err,
             Contains("1 joint (art/sprites/out/boy.skeleton.json), limbs (art/sprites/out/boy.layers.png)"));
}

TEST_CASE("a sprite in other colours lost what was mended of it where its silhouette was painted by hand") {
  const TempDir dir;
  drawSprite(dir);
  const std::string mask = paintedMask(dir);
  const bool in_place = GENERATE(true, false);  // or given
  const std::string painted = in_place ? "out/boy.silhouette.png" : "hat.png";
  const std::string call =
      std::string("boy.png --formats glb,json,silhouette,layers") + (in_place ? "" : " --mask hat.png");
  REQUIRE(infer(dir, "boy.png --formats json,silhouette").exit_code == 0);
  writeFile(dir.file(painted), mask);
  REQUIRE(infer(dir, call).exit_code == 0);
  moveInFile(dir, "left_hand", "420.5");
  const std::string layers = paintOverLeg(dir), mended = readFile(dir.file(kSkeleton));
  const std::string taken_up = kTakenUp + std::string("1 joint (out/boy.skeleton.json), ") +
                               (in_place ? "silhouette (" + painted + "), " : "") +
                               "limbs (out/boy.layers.png)\n";
  SECTION("now they stay, in its first colours again, too") {
    for (int time = 1; time <= 3; ++time) {
      recolor(dir);
      for (int run = 1; run <= 2; ++run) {
        const ToolRun again = infer(dir, call);
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, Contains(taken_up));
        CHECK(again.err.find("look at") == std::string::npos);
        CHECK(again.err.find("kept") == std::string::npos);
        CHECK(placeIn(dir, "left_hand").front() == 420.5);
        CHECK(readFile(dir.file("out/boy.layers.png")) == layers);
      }
    }
  }
  SECTION("of another outline they are kept") {
    recolor(dir);
    cutOffFeet(dir);
    const ToolRun run = infer(dir, call);
    CHECK_THAT(run.err, Contains("boy.skeleton.json (now boy.skeleton.old.json; "));
    CHECK_THAT(run.err, Contains("boy.layers.png (now boy.old.layers.png), as the picture has changed\n"));
    CHECK(readFile(dir.file("out/boy.skeleton.old.json")) == mended);
    CHECK(readFile(dir.file("out/boy.old.layers.png")) == layers);
    if (in_place) CHECK(readFile(dir.file("out/boy.old.silhouette.png")) == mask);
  }
}

TEST_CASE(
    "labels of a sprite in other colours, and their mask, counted once and were put aside by the next run") {
  const TempDir dir;
  drawSprite(dir);
  writeFile(dir.file("boy.mask.png"), paintedMask(dir));
  const bool of_joints = GENERATE(true, false);  // or of the mask alone
  placeInLabels(dir, {420, 300}, "boy.mask.png");
  if (!of_joints) {
    LabelFile labels = readLabelFile(dir.file("boy.labels.json"));
    labels.recognized = {"left_hand", "right_hand"};
    writeLabelFile(dir.file("boy.labels.json"), labels);
  }
  for (int time = 0; time <= 3; ++time) {
    for (int run = 1; run <= 2; ++run) {
      const ToolRun again = infer(dir, "boy.png --formats json");
      CHECK(again.exit_code == 0);
      CHECK_THAT(again.err, Contains("mask (boy.mask.png)\n"));
      CHECK(again.err.find("earlier picture") == std::string::npos);
      CHECK((again.err.find("1 joint") != std::string::npos) == of_joints);
    }
    recolor(dir);
  }
  cutOffFeet(dir);
  CHECK_THAT(infer(dir, "boy.png --formats json").err, Contains("boy.labels.json, boy.mask.png"));
}

TEST_CASE("a mended skeleton keeps its name where the new photo writes none or is no picture") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  moveInFile(dir, "left_hand", "300.5");
  const std::string mended = readFile(dir.file("out/boy.skeleton.json"));
  takeAgain(dir, "clown");
  CHECK_THAT(infer(dir, "boy.png --formats silhouette").err,
             Contains(kEarlier + std::string("boy.skeleton.json\n")));
  CHECK(readFile(dir.file("out/boy.skeleton.json")) == mended);
  writeFile(dir.file("boy.png"), "no picture");
  CHECK(infer(dir, "boy.png").exit_code == 2);
  CHECK(readFile(dir.file("out/boy.skeleton.json")) == mended);
}

TEST_CASE(
    "labels of the photo that was there before, and the mask that they speak of, are left out and stay") {
  const TempDir dir;
  drawBoy(dir);
  fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.mask.png"));
  placeInLabels(dir, {420, 300}, "boy.mask.png");
  takeAgain(dir, "clown");
  const std::string labels = readFile(dir.file("boy.labels.json"));
  const ToolRun run = infer(dir, "boy.png");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains(kEarlier + std::string("boy.labels.json, boy.mask.png\n")));
  CHECK(readFile(dir.file("boy.labels.json")) == labels);
  REQUIRE(infer(dir, "boy.png -o forced --force").exit_code == 0);
  CHECK(readFile(dir.file("out/boy.glb")) == readFile(dir.file("forced/boy.glb")));
  SECTION("named by --skeleton they are refused, with what to do") {
    const ToolRun named = infer(dir, "boy.png --skeleton boy.labels.json");
    CHECK(named.exit_code == 2);
    CHECK_THAT(named.err,
               Contains("boy.labels.json: was made for another picture than boy.png; place the joints "
                        "anew (skel-label boy.png)"));
  }
}

TEST_CASE("a mask that was there before the photo was taken again is taken up and to be looked at") {
  const TempDir dir;
  drawBoy(dir);
  fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.mask.png"));
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  const auto said = [&] {
    return infer(dir, "boy.png")
               .err.find("the mask was there before the picture changed: look at it (skel-label boy.png)") !=
           std::string::npos;
  };
  SECTION("of the same size, in every run until it is painted anew or looked at: it was said once") {
    takeAgain(dir, "clown");
    for (int run = 1; run <= 3; ++run) CHECK(said());
    if (GENERATE(true, false))
      placeInLabels(dir, {300, 300}, "boy.mask.png");
    else
      fs::copy(SKEL_DATASETS "/characters/clown.mask.png", dir.file("boy.mask.png"),
               fs::copy_options::overwrite_existing);
    for (int run = 1; run <= 2; ++run) CHECK_FALSE(said());
  }
  SECTION("not one that was painted since") {
    takeAgain(dir, "clown");
    fs::copy(SKEL_DATASETS "/characters/clown.mask.png", dir.file("boy.mask.png"),
             fs::copy_options::overwrite_existing);
    CHECK_FALSE(said());
  }
  SECTION("nor one that labels of the new picture speak of") {
    takeAgain(dir, "clown");
    placeInLabels(dir, {300, 300}, "boy.mask.png");
    CHECK_FALSE(said());
  }
  SECTION("of another size it is left out, and so are limbs") {
    writeFile(dir.file("boy.png"), encodePng(capsuleImage({.size = 500})));
    fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.limbs.png"));
    for (int run = 1; run <= 2; ++run)  // the second one failed
      CHECK_THAT(
          infer(dir, "boy.png").err,
          Contains("note: of another size than the picture, not taken up: boy.mask.png (of 600x600 px, "
                   "the picture has 500x500), boy.limbs.png (of 600x600 px, the picture has "
                   "500x500)\n"));
  }
}

TEST_CASE(
    "a photo that was taken again wore the limbs of the one before, from the second run on without a word") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats layers -o plain").exit_code == 0);
  fs::copy(dir.file("plain/boy.layers.png"), dir.file("boy.limbs.png"));
  const std::string taken_up = "limbs (boy.limbs.png)\n";
  SECTION("labels tell of which photo they are: they are left out until a person has looked at them") {
    placeInLabels(dir, {420, 300});
    CHECK_THAT(infer(dir, "boy.png").err, Contains(taken_up));
    takeAgain(dir, "clown");
    for (int run = 1; run <= 3; ++run) {
      const ToolRun again = infer(dir, "boy.png");
      CHECK_THAT(again.err, Contains(kEarlier) && Contains("boy.labels.json, boy.limbs.png\n"));
      CHECK_THAT(again.err, !Contains("taken up (--force"));
    }
    placeInLabels(dir, {300, 300});
    for (int run = 1; run <= 2; ++run)
      CHECK_THAT(infer(dir, "boy.png").err, Contains(taken_up) && !Contains("one before"));
  }
  SECTION("without labels they are taken up and to be looked at, until they are painted anew or looked at") {
    CHECK_THAT(infer(dir, "boy.png").err, Contains(taken_up) && !Contains("one before"));
    takeAgain(dir, "clown");
    for (int run = 1; run <= 3; ++run)
      CHECK_THAT(infer(dir, "boy.png").err,
                 Contains(taken_up) &&
                     Contains("the picture has changed, the limbs may be painted for the one before: look at "
                              "them (skel-label boy.png, key G)"));
    if (GENERATE(true, false)) {
      placeInLabels(dir, {300, 300});
    } else {
      REQUIRE(infer(dir, "boy.png --force --formats layers -o plain").exit_code == 0);
      fs::copy(dir.file("plain/boy.layers.png"), dir.file("boy.limbs.png"),
               fs::copy_options::overwrite_existing);
    }
    for (int run = 1; run <= 2; ++run)
      CHECK_THAT(infer(dir, "boy.png").err, Contains(taken_up) && !Contains("one before"));
  }
}

TEST_CASE("limbs stay with a sprite that got other colours, whatever labels beside them say") {
  const TempDir dir;
  drawSprite(dir);
  REQUIRE(infer(dir, "boy.png --formats layers -o plain").exit_code == 0);
  fs::copy(dir.file("plain/boy.layers.png"), dir.file("boy.limbs.png"));
  placeInLabels(dir, {420, 300});
  if (GENERATE(true, false)) takeBackInLabels(dir);
  for (int time = 0; time <= 2; ++time) {
    for (int run = 1; run <= 2; ++run)
      CHECK_THAT(infer(dir, "boy.png --formats json").err, Contains("limbs (boy.limbs.png)\n") &&
                                                               !Contains("one before") &&
                                                               !Contains("earlier picture"));
    recolor(dir);
  }
}

TEST_CASE("option --quiet, and warnings in --json, said nothing of joints that the new photo drops") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  moveInFile(dir, "left_hand", "300.5");
  takeAgain(dir, "clown");
  const std::string dropped = kEarlier + std::string("boy.skeleton.json (now boy.skeleton.old.json; ");
  const ToolRun run = infer(dir, "boy.png --quiet --json");
  CHECK_THAT(run.err, StartsWith("boy.png: note: " + dropped));
  CHECK_THAT(run.out, Contains("\"verdict\":\"look at\",\"warnings\":[\"" + dropped));
  CHECK(infer(dir, "boy.png --quiet").err.empty());
}

TEST_CASE("a drawing whose mended skeleton was refused stayed refused with --resume after it was repaired") {
  const TempDir dir;
  drawBoy(dir);
  const std::string line = "boy.png --resume --formats json";
  REQUIRE(infer(dir, line).exit_code == 0);
  const std::string found = readFile(dir.file(kSkeleton));
  moveInFile(dir, "left_hand", "420.5");
  const std::string mended = readFile(dir.file(kSkeleton));
  std::string broken = mended;
  broken.replace(broken.find("left_elbow"), 10, "left_elbo");
  writeFile(dir.file(kSkeleton), broken);
  for (int run = 1; run <= 2; ++run) {  // the second one is told what the first was
    const ToolRun refused = infer(dir, line);
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("is no joint of the template \"biped\""));
  }
  SECTION("repaired") {
    writeFile(dir.file(kSkeleton), mended);
    CHECK_THAT(infer(dir, line).err, Contains(kTakenUp + std::string("1 joint (out/boy.skeleton.json)\n")));
    CHECK_THAT(infer(dir, line).out, Contains("done before"));
    CHECK(placeIn(dir, "left_hand")[0] == 420.5);
  }
  SECTION("as it was") {
    writeFile(dir.file(kSkeleton), found);
    CHECK(infer(dir, line).exit_code == 0);
  }
  SECTION("gone") {
    fs::remove(dir.file(kSkeleton));
    CHECK(infer(dir, line).exit_code == 0);
    CHECK(readFile(dir.file(kSkeleton)) == found);
  }
}

TEST_CASE("a skeleton file with a mistyped joint was written over without a word where none was moved") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats json").exit_code == 0);
  std::string mistyped = readFile(dir.file(kSkeleton));
  mistyped.replace(mistyped.find("left_elbow"), 10, "left_elbo");
  writeFile(dir.file(kSkeleton), mistyped);
  const ToolRun run = infer(dir, "boy.png --formats json");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("out/boy.skeleton.json: ") && Contains("\"left_elbo\" is no joint"));
  CHECK(readFile(dir.file(kSkeleton)) == mistyped);
  CHECK(infer(dir, "boy.png --formats json --force").exit_code == 0);
}

TEST_CASE("joints that nobody moved stay where the edited skeleton file has them") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  // As after a guess: the file is what the person saw, whatever skel would find again.
  std::string text = readFile(dir.file("out/boy.skeleton.json"));
  for (const char* name : {"left_hand", "right_shoulder", "right_elbow"}) {
    const size_t origin = text.find("\"origin\":\"", text.find("\"name\":\"" + std::string(name))) + 10;
    text.replace(origin, text.find('"', origin) - origin, name[0] == 'l' ? "completed" : "edited");
  }
  text.replace(text.find("\"missing\": []"), 13, "\"missing\": [\"left_hand\"]");
  writeFile(dir.file("out/boy.skeleton.json"), text);
  moveInFile(dir, "right_elbow", "150");
  moveInFile(dir, "left_hand", "405.5");
  moveInFile(dir, "left_foot", "330.25");
  const auto joints = [&] {
    std::vector<std::vector<double>> places;
    const JsonDocument document = JsonDocument::readFile(dir.file("out/boy.skeleton.json"));
    for (const JsonValue& joint : document.root().at("joints").items())
      places.push_back(joint.at("image").asNumbers(2));
    return places;
  };
  const auto before = joints();
  CHECK(infer(dir, "boy.png").exit_code == 0);
  CHECK(joints() == before);
}

TEST_CASE("a limb that is still missing is still told of when another joint was placed") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  std::string text = readFile(dir.file("out/boy.skeleton.json"));
  text.replace(text.find("\"missing\": []"), 13, "\"missing\": [\"left_hand\"]");
  writeFile(dir.file("out/boy.skeleton.json"), text);
  moveInFile(dir, "right_hand", "150");
  constexpr const char* kMissing = "not found: left_hand (placed where it probably is)";
  CHECK_THAT(infer(dir, "boy.png").err, Contains(kMissing));
  moveInFile(dir, "left_hand", "420.5");
  CHECK(infer(dir, "boy.png").err.find("not found") == std::string::npos);
}

TEST_CASE("joints that a person has all placed are sure, and the report says who placed them") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  LabelFile labels;
  labels.image = {"boy.png", sha256(readFile(dir.file("boy.png")))};
  labels.image_width = labels.image_height = 600;
  labels.grid_width = labels.grid_height = kWorkingGridSize;
  for (const TemplateJoint& joint : loadTemplate("biped").joints) {
    const auto place = placeIn(dir, joint.name);
    if (!joint.derived) labels.joints.emplace_back(joint.name, Eigen::Vector2d(place[0], place[1] - 1));
  }
  writeLabelFile(dir.file("boy.labels.json"), labels);
  for (int time = 0; time < 2; ++time) {
    CHECK_THAT(infer(dir, "boy.png --report report.html").out, Contains("  joints placed by hand  biped"));
    const std::string html = readFile(dir.file("report.html"));
    CHECK_THAT(html, Contains("a person has placed the joints"));
    CHECK(html.find("sure of the joints") == std::string::npos);
  }
}

TEST_CASE(
    "a silhouette that was painted in place is taken up as the mask, said in one line, and stays as "
    "painted") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  const std::string path = dir.file("out/boy.silhouette.png"), found = readFile(path);
  CHECK(infer(dir, "boy.png").err.find("silhouette") == std::string::npos);
  Plane8 mask = readMask(path);
  mask.block(300, 240, 60, 120) = 255;
  mask.block(0, 0, 20, 20) = 255;  // a stray stroke, which is no part of the figure
  const std::string painted = encodePng(mask);
  REQUIRE(painted != found);
  writeFile(path, painted);
  writeFile(dir.file("named.png"), painted);
  REQUIRE(infer(dir, "boy.png -o named --mask named.png").exit_code == 0);
  for (int time = 0; time < 2; ++time) {
    const ToolRun run = infer(dir, "boy.png");
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Contains(kTakenUp + std::string("silhouette (out/boy.silhouette.png)\n")));
    CHECK(readFile(path) == painted);
    CHECK(readFile(dir.file("out/boy.glb")) == readFile(dir.file("named/boy.glb")));
  }
  SECTION("with --resume it is done once more, and then left") {
    CHECK(infer(dir, "boy.png --resume").out.find("done before") == std::string::npos);
    CHECK_THAT(infer(dir, "boy.png --resume").out, Contains("done before"));
    CHECK(readFile(path) == painted);
  }
  SECTION("--force leaves it out and writes over it") {
    CHECK(infer(dir, "boy.png --force").exit_code == 0);
    CHECK(readFile(path) == found);
  }
  SECTION("of a photo that was taken again it is left out and kept") {
    takeAgain(dir, "clown");
    CHECK_THAT(infer(dir, "boy.png").err,
               Contains(kEarlier + std::string("boy.silhouette.png (now boy.old.silhouette.png)\n")));
    CHECK(readFile(dir.file("out/boy.old.silhouette.png")) == painted);
  }
  SECTION("a mask beside the drawing comes first") {
    fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.mask.png"));
    CHECK_THAT(
        infer(dir, "boy.png").err,
        Contains(kTakenUp + std::string("mask (boy.mask.png; not out/boy.silhouette.png, which differs)\n")));
  }
}

// Repaints what the layers have as the left leg for the trunk; returns how many pixels that were.
int paintOverLeftLeg(const std::string& path) {
  Image picture = readImage(path);
  int changed = 0;
  for (Eigen::Index p = 0; p < picture.rgba.rows(); ++p)
    if (picture.rgba(p, 0) == 40 && picture.rgba(p, 1) == 170 && picture.rgba(p, 2) == 80) {
      picture.rgba.row(p) << 150, 150, 150, 255;
      ++changed;
    }
  writeFile(path, encodePng(picture));
  return changed;
}

TEST_CASE("layers that were painted in place are taken up, said in one line, and stay as painted") {
  const TempDir dir;
  drawBoy(dir);
  const std::string call = "boy.png --formats glb,json,layers";
  REQUIRE(infer(dir, call).exit_code == 0);
  const std::string path = dir.file("out/boy.layers.png"), found = readFile(path);
  CHECK(infer(dir, call).err.find("layers.png") == std::string::npos);
  // As a program for painting saves it: the left arm's colour where the left leg was.
  REQUIRE(paintOverLeftLeg(path) > 100);
  const std::string painted = readFile(path);
  writeFile(dir.file("named.png"), painted);
  REQUIRE(infer(dir, "boy.png --formats glb -o named --layers named.png").exit_code == 0);
  SECTION("by each run from then on, also by one that writes no layers") {
    for (const std::string& again : {call, call, std::string("boy.png --formats glb,json")}) {
      const ToolRun run = infer(dir, again);
      CHECK(run.exit_code == 0);
      CHECK_THAT(run.err, Contains(kTakenUp + std::string("limbs (out/boy.layers.png)\n")));
      CHECK(readFile(path) == painted);
      CHECK(readFile(dir.file("out/boy.glb")) == readFile(dir.file("named/boy.glb")));
    }
  }
  SECTION("with --resume it is done once more, and then left") {
    CHECK(infer(dir, call + " --resume").out.find("done before") == std::string::npos);
    CHECK_THAT(infer(dir, call + " --resume").out, Contains("done before"));
    CHECK(readFile(path) == painted);
  }
  SECTION("--force leaves it out and writes over it") {
    CHECK(infer(dir, call + " --force").exit_code == 0);
    CHECK(readFile(path) == found);
  }
  SECTION("a run that goes by others keeps it under another name") {
    const auto keeps = [&](const std::string& now) {
      CAPTURE(now);
      const ToolRun run = infer(dir, call + " --layers off");
      CHECK(run.exit_code == 0);
      CHECK_THAT(run.err,
                 Contains("painted by hand, not taken up and kept: boy.layers.png (now " + now + ")"));
      CHECK(readFile(dir.file("out/" + now)) == painted);
      CHECK(infer(dir, call + " --layers off").err.find("painted") == std::string::npos);
    };
    keeps("boy.old.layers.png");
    writeFile(path, painted);
    keeps("boy.old-2.layers.png");
  }
  SECTION("of a photo that was taken again it is left out and kept") {
    takeAgain(dir, "clown");
    const ToolRun run = infer(dir, call);
    CHECK_THAT(run.err, Contains("boy.layers.png (now boy.old.layers.png), as the picture has changed\n"));
    CHECK(run.err.find(kEarlier) == run.err.npos);
    CHECK(readFile(dir.file("out/boy.old.layers.png")) == painted);
  }
  SECTION("of another size they were said to be of an earlier picture") {
    const std::string shrunk = encodePng(capsuleImage({.size = 300}));
    writeFile(path, shrunk);
    CHECK_THAT(infer(dir, "boy.png --formats json").err,
               Contains("of another size than the picture, not taken up: boy.layers.png (of 300x300 px, the "
                        "picture has 600x600)\n"));
    CHECK(readFile(path) == shrunk);
    CHECK_THAT(infer(dir, call).err,
               Contains("painted by hand, not taken up and kept: boy.layers.png (now boy.old.layers.png), as "
                        "it is of 300x300 px, the picture has 600x600\n"));
    CHECK(readFile(dir.file("out/boy.old.layers.png")) == shrunk);
  }
  SECTION("limbs of skel-label come first") {
    writeFile(dir.file("boy.limbs.png"), found);
    CHECK_THAT(
        infer(dir, call).err,
        Contains(kTakenUp + std::string("limbs (boy.limbs.png; not out/boy.layers.png, which differs)")));
    CHECK(readFile(dir.file("out/boy.old.layers.png")) == painted);
  }
}

TEST_CASE(
    "limbs that were painted for the picture before were dropped without a word, and taken up for the new "
    "one "
    "later") {
  const TempDir dir;
  drawBoy(dir);
  const std::string all = "boy.png --formats json,layers", path = dir.file("out/boy.layers.png");
  REQUIRE(infer(dir, all).exit_code == 0);
  REQUIRE(paintOverLeftLeg(path) > 100);
  const std::string painted = readFile(path);
  takeAgain(dir, "clown");
  const ToolRun film = runTool("cd '" + dir.path() +
                               "' && skel-animate render boy.png --clip wave --duration 0.1 --fps 10 --size "
                               "64x64 -o film.gif");
  CHECK(film.exit_code == 0);
  CHECK_THAT(film.err, Contains(kEarlier + std::string("boy.layers.png\n")));
  CHECK_THAT(infer(dir, "boy.png --formats json -o elsewhere").err,
             Contains(kEarlier + std::string("boy.layers.png\n")));
  CHECK(readFile(path) == painted);
  for (const std::string options : {"", " --force", " --layers off", " --figure 1"}) {
    CAPTURE(options);
    CHECK_THAT(infer(dir, "boy.png --formats json" + options).err,
               Contains("boy.layers.png (now boy.old.layers.png), as the picture has changed\n"));
    CHECK(readFile(dir.file("out/boy.old.layers.png")) == painted);
    CHECK(infer(dir, all).err.find("limbs") == std::string::npos);
    fs::remove(dir.file("out/boy.old.layers.png"));
    drawBoy(dir);
    REQUIRE(infer(dir, all + " --force").exit_code == 0);
    writeFile(path, painted);
    takeAgain(dir, "clown");
  }
}

TEST_CASE(
    "a silhouette of skel's own, older than its skeleton file, was taken for one that a person painted") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats json,silhouette").exit_code == 0);
  takeAgain(dir, "clown");
  for (int time = 0; time < 2; ++time) {
    const ToolRun run = infer(dir, "boy.png --formats json");
    CHECK(run.exit_code == 0);
    CHECK(run.err.find("silhouette") == run.err.npos);
  }
}

TEST_CASE("a patch of a limb that was painted apart from the rest of it was dropped without a word") {
  const TempDir dir;
  drawBoy(dir);
  const std::string call = "boy.png --formats glb,json,layers";
  REQUIRE(infer(dir, call).exit_code == 0);
  Image layers = readImage(dir.file("out/boy.layers.png"));
  const auto isWhole = [&](int x, int y, int side) {
    for (int v = y; v < y + side; ++v)
      for (int u = x; u < x + side; ++u)
        if (layers.pixel(u, v)[3] == 0) return false;
    return true;
  };
  // Two squares, one above the other.
  std::vector<std::pair<int, int>> corners;
  for (int y = 0; y + 40 < layers.height && corners.size() < 2; ++y)
    for (int x = 0; x + 40 < layers.width; ++x)
      if (isWhole(x, y, 40)) {
        corners.emplace_back(x, y);
        y += 60;
        break;
      }
  REQUIRE(corners.size() == 2);
  for (Eigen::Index p = 0; p < layers.rgba.rows(); ++p)
    if (layers.rgba(p, 3) > 0) layers.rgba.row(p) << 150, 150, 150, 255;
  for (const int side : {40, 20}) {
    const auto [x0, y0] = corners[side == 40 ? 0 : 1];
    for (int y = y0; y < y0 + side; ++y)
      for (int x = x0; x < x0 + side; ++x) {
        const std::uint8_t right_arm[] = {230, 60, 60, 255};
        std::copy_n(right_arm, 4, layers.pixel(x, y));
      }
  }
  writeFile(dir.file("out/boy.layers.png"), encodePng(layers));
  const ToolRun run = infer(dir, call);
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err,
             Contains("400 px painted as the right arm are not joined to the rest of it and stay with the "
                      "body: look at them (skel-label boy.png, key G)"));
}

TEST_CASE("of both arms painted in one colour none was said to be missing") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats layers").exit_code == 0);
  Image limbs = readImage(dir.file("out/boy.layers.png"));
  for (Eigen::Index p = 0; p < limbs.rgba.rows(); ++p) {
    if (limbs.rgba(p, 3) > 0) limbs.rgba(p, 3) = 255;
    if (limbs.rgba(p, 0) == 230 && limbs.rgba(p, 1) == 60) limbs.rgba.row(p) << 50, 110, 230, 255;
  }
  writeFile(dir.file("boy.limbs.png"), encodePng(limbs));
  CHECK_THAT(infer(dir, "boy.png --formats glb").err,
             Contains(" px painted as the left arm are not joined to the rest of it and stay with the body, "
                      "and none are painted as the right arm: look at them (skel-label boy.png, key G)"));
}

TEST_CASE("what skel wrote and nobody touched is not taken for mended") {
  const TempDir dir;
  drawBoy(dir);
  const std::string formats = "boy.png -o . --formats glb,json,overlay,silhouette,layers";
  REQUIRE(infer(dir, formats).exit_code == 0);
  const std::string first = readFile(dir.file("boy.glb"));
  const ToolRun again = infer(dir, formats);
  CHECK(again.err.find("by hand") == again.err.npos);
  CHECK(readFile(dir.file("boy.glb")) == first);
}

TEST_CASE("joints placed in skel-label's folder mode are taken up, and changed by either file afterwards") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  const auto right = placeIn(dir, "right_hand");
  const auto found = placeIn(dir, "left_hand");
  placeInLabels(dir, {found[0] - 8, found[1]});
  CHECK_THAT(infer(dir, "boy.png").err, Contains(kTakenUp + std::string("1 joint (boy.labels.json)\n")));
  CHECK(placeIn(dir, "left_hand")[0] == Approx(found[0] - 8));
  CHECK(placeIn(dir, "right_hand") == right);  // that one was found by a net, not placed
  SECTION("later runs name the file that it was placed in, too") {
    CHECK_THAT(infer(dir, "boy.png").err, Contains(kTakenUp + std::string("1 joint (boy.labels.json)\n")));
  }
  SECTION("a later edit of the skeleton file counts, as the labels are the ones it was made with") {
    moveInFile(dir, "left_hand", "430");
    REQUIRE(infer(dir, "boy.png").exit_code == 0);
    CHECK(placeIn(dir, "left_hand")[0] == 430);
  }
  SECTION("later labels count") {
    placeInLabels(dir, {found[0] - 4, found[1]});
    REQUIRE(infer(dir, "boy.png").exit_code == 0);
    CHECK(placeIn(dir, "left_hand")[0] == Approx(found[0] - 4));
  }
}

TEST_CASE(
    "a joint that was moved in the skeleton file lost against labels that had been imported from it before") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png -o . --formats json").exit_code == 0);
  const std::string skeleton = "boy.skeleton.json";
  moveInFile(dir, "left_hand", "430", skeleton);
  const auto right = placeIn(dir, "right_hand", skeleton);
  const double y = placeIn(dir, "left_hand", skeleton)[1];
  placeInLabels(dir, {430, y});
  SECTION("the skeleton is the later one") {
    moveInFile(dir, "left_hand", "440", skeleton);
    const ToolRun run = infer(dir, "boy.png -o . --formats json");
    CHECK_THAT(run.err,
               Contains("joints that two files place elsewhere, by hand: the one written later counts: "
                        "./boy.skeleton.json, not ./boy.labels.json: left_hand\n"));
    CHECK(placeIn(dir, "left_hand", skeleton)[0] == 440);
    const std::string once = readFile(dir.file(skeleton));
    CHECK(infer(dir, "boy.png -o . --formats json").err.find("two files") == std::string::npos);
    CHECK(readFile(dir.file(skeleton)) == once);
  }
  SECTION("the labels are the later ones") {
    moveInFile(dir, "left_hand", "440", skeleton);
    moveInFile(dir, "right_foot", "250", skeleton);
    const std::string before = readFile(dir.file(skeleton));
    placeInLabels(dir, {435, y});
    CHECK_THAT(
        infer(dir, "boy.png -o . --formats json").err,
        Contains("boy.labels.json, not ./boy.skeleton.json (now ./boy.skeleton.old.json): left_hand\n"));
    CHECK(placeIn(dir, "left_hand", skeleton)[0] == Approx(435));
    CHECK(placeIn(dir, "right_foot", skeleton)[0] == 250);
    CHECK(readFile(dir.file("boy.skeleton.old.json")) == before);
    CHECK(infer(dir, "boy.png -o . --formats json").err.find("two files") == std::string::npos);
    CHECK(placeIn(dir, "left_hand", skeleton)[0] == Approx(435));
    CHECK_FALSE(fs::exists(dir.file("boy.skeleton.old-2.json")));
  }
}

TEST_CASE("a joint stayed, and was said to be made by hand, when its placing was undone in the labels") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats json").exit_code == 0);
  const auto found = placeIn(dir, "left_hand");
  const auto fresh = readFile(dir.file("out/boy.skeleton.json"));
  placeInLabels(dir, {found[0] - 9, found[1]});
  CHECK_THAT(infer(dir, "boy.png --formats json").err, Contains("1 joint (boy.labels.json)"));
  REQUIRE(placeIn(dir, "left_hand")[0] == Approx(found[0] - 9));
  takeBackInLabels(dir);
  SECTION("it alone") {
    CHECK(infer(dir, "boy.png --formats json").err.find("made by hand") == std::string::npos);
    CHECK(readFile(dir.file("out/boy.skeleton.json")) == fresh);
  }
  SECTION("what was moved in the skeleton file stays") {
    moveInFile(dir, "right_foot", "250");
    CHECK_THAT(infer(dir, "boy.png --formats json").err, Contains("1 joint (out/boy.skeleton.json)"));
    CHECK(placeIn(dir, "right_foot")[0] == 250);
    CHECK(placeIn(dir, "left_hand")[0] == Approx(found[0]).margin(30));
    CHECK(placeIn(dir, "left_hand")[0] != Approx(found[0] - 9));
  }
}

TEST_CASE("of a joint that was placed twice in the labels two files were said to place it elsewhere") {
  const TempDir dir;
  drawBoy(dir);
  placeInLabels(dir, {430, 300});
  REQUIRE(infer(dir, "boy.png --formats json").exit_code == 0);
  placeInLabels(dir, {440, 300});
  fs::last_write_time(dir.file("out/boy.skeleton.json"),
                      fs::last_write_time(dir.file("boy.labels.json")) + std::chrono::seconds(5));
  const ToolRun run = infer(dir, "boy.png --formats json");
  CHECK(run.err == "boy.png: note: " + std::string(kTakenUp) + "1 joint (boy.labels.json)\n");
  CHECK(placeIn(dir, "left_hand")[0] == 440);
}

TEST_CASE("an animal that was chosen in skel-label, no joint placed, was rigged as a biped") {
  const TempDir dir;
  drawBoy(dir);
  LabelFile labels = labelImage(dir.file("boy.png"), std::nullopt, {}, loadTemplate("quadruped"));
  labels.joints.clear();
  const SkeletonTemplate quadruped = loadTemplate("quadruped");
  for (const auto& joint : quadruped.joints) labels.joints.emplace_back(joint.name, std::nullopt);
  writeLabelFile(dir.file("boy.labels.json"), labels);
  CHECK_THAT(infer(dir, "boy.png --formats json").err,
             Contains(std::string(kTakenUp) + "the body plan quadruped (boy.labels.json)"));
  CHECK(
      readSkeletonFile(dir.file("out/boy.skeleton.json"), loadTemplate("quadruped")).skeleton.template_name ==
      "quadruped");
  CHECK(infer(dir, "boy.png --formats json --template biped").err.find("made by hand") == std::string::npos);
}

TEST_CASE("a model that the window of skel-animate had saved, with own clips, was written over") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png --formats glb").exit_code == 0);
  const std::string made = readFile(dir.file("out/boy.glb"));
  const CharacterFile boy = readGlb(dir.file("out/boy.glb"));
  const std::string saved = encodeGlb(boy.character, {}, {.generator = "skel-animate view"});
  writeFile(dir.file("out/boy.glb"), saved);
  SECTION("it is kept") {
    CHECK_THAT(infer(dir, "boy.png --formats glb").err,
               Contains("a model that skel-infer did not write is kept: boy.glb is now boy.old.glb (by "
                        "skel-animate view)"));
    CHECK(readFile(dir.file("out/boy.old.glb")) == saved);
    CHECK(readFile(dir.file("out/boy.glb")) == made);
    CHECK(infer(dir, "boy.png --formats glb").err.find("is kept") == std::string::npos);
  }
  SECTION("not with --force") {
    CHECK(infer(dir, "boy.png --formats glb --force").exit_code == 0);
    CHECK_FALSE(fs::exists(dir.file("out/boy.old.glb")));
  }
}

TEST_CASE("a mask, painted limbs and a back beside the drawing are taken up") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png -o plain --formats glb,layers").exit_code == 0);
  fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file("boy.mask.png"));
  fs::copy(dir.file("plain/boy.layers.png"), dir.file("boy.limbs.png"));
  fs::copy(kDrawing, dir.file("boy.back.png"));
  const ToolRun run = infer(dir, "boy.png");
  CHECK_THAT(
      run.err,
      Contains(kTakenUp + std::string("mask (boy.mask.png), limbs (boy.limbs.png), back (boy.back.png)\n")));
  REQUIRE(infer(dir, "boy.png -o named --mask boy.mask.png --layers boy.limbs.png --back boy.back.png")
              .exit_code == 0);
  CHECK(readFile(dir.file("out/boy.glb")) == readFile(dir.file("named/boy.glb")));
  SECTION("--force leaves them out") {
    const ToolRun forced = infer(dir, "boy.png -o forced --force");
    CHECK(forced.err.find("by hand") == forced.err.npos);
    CHECK(readFile(dir.file("forced/boy.glb")) == readFile(dir.file("plain/boy.glb")));
  }
  SECTION("beside an annotated drawing they are the truth to measure by, and left alone") {
    fs::copy(SKEL_DATASETS "/characters/cap_boy.joints.json", dir.file("boy.joints.json"));
    const ToolRun annotated = infer(dir, "boy.png -o annotated");
    CHECK(annotated.err.find("by hand") == annotated.err.npos);
    CHECK(readFile(dir.file("annotated/boy.glb")) == readFile(dir.file("plain/boy.glb")));
  }
}

TEST_CASE("option --skeleton takes the joints of a label file, or says what to do where it has none") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  const auto found = placeIn(dir, "left_hand");
  placeInLabels(dir, {found[0] - 8, found[1]});
  fs::rename(dir.file("boy.labels.json"), dir.file("mine.labels.json"));
  CHECK(infer(dir, "boy.png --skeleton mine.labels.json").exit_code == 0);
  CHECK(placeIn(dir, "left_hand")[0] == Approx(found[0] - 8));
  LabelFile labels = readLabelFile(dir.file("mine.labels.json"));
  labels.joints.clear();
  labels.recognized.clear();
  writeLabelFile(dir.file("none.labels.json"), labels);
  const ToolRun none = infer(dir, "boy.png --skeleton none.labels.json --force");
  CHECK(none.exit_code == 2);
  CHECK_THAT(none.err, Contains("none.labels.json: holds no joints, only classes of candidates; place them "
                                "(skel-label boy.png, key J)"));
}

TEST_CASE(
    "what was mended beside the drawing, in out/ beside it or in out/ of the working directory is taken up "
    "by a run that writes elsewhere, which leaves it alone") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  const std::string folder = GENERATE("in", "in/out", "out");
  CAPTURE(folder);
  const std::string skeleton = folder + "/boy.skeleton.json";
  REQUIRE(infer(dir, "in/boy.png -o " + folder).exit_code == 0);
  const auto found = placeIn(dir, "left_hand", skeleton);
  SECTION("what nobody has touched changes nothing and is not spoken of") {
    const ToolRun run = infer(dir, "in/boy.png -o fresh");
    CHECK(run.err.find("by hand") == run.err.npos);
    CHECK(readFile(dir.file("fresh/boy.glb")) == readFile(dir.file(folder + "/boy.glb")));
  }
  SECTION("joints") {
    moveInFile(dir, "left_hand", "420.5", skeleton);
    const auto before = contentOf(dir, folder);
    for (int time = 0; time < 2; ++time) {  // afterwards they are in the run's own skeleton file, too
      const ToolRun run = infer(dir, "in/boy.png -o fresh");
      CHECK(run.exit_code == 0);
      CHECK_THAT(run.err, Contains(kTakenUp + std::string("1 joint (") +
                                   (time == 0 ? skeleton : "fresh/boy.skeleton.json") + ")\n"));
      CHECK(placeIn(dir, "left_hand", "fresh/boy.skeleton.json") == std::vector<double>{420.5, found[1]});
    }
    CHECK(contentOf(dir, folder) == before);
    const ToolRun forced = infer(dir, "in/boy.png -o forced --force");
    CHECK(forced.err.find("by hand") == forced.err.npos);
    CHECK(placeIn(dir, "left_hand", "forced/boy.skeleton.json") == found);
    CHECK(contentOf(dir, folder) == before);
    SECTION("and a run with --resume is done again after they were moved") {
      CHECK(infer(dir, "in/boy.png -o resumed --resume --formats glb").exit_code == 0);
      CHECK_THAT(infer(dir, "in/boy.png -o resumed --resume --formats glb").out, Contains("done before"));
      moveInFile(dir, "left_hand", "410.5", skeleton);
      CHECK(infer(dir, "in/boy.png -o resumed --resume --formats glb").out.find("done before") ==
            std::string::npos);
    }
  }
  SECTION("a painted silhouette, limbs and a mask") {
    const std::string silhouette = folder + "/boy.silhouette.png";
    Plane8 mask = readMask(dir.file(silhouette));
    mask.block(300, 240, 60, 120) = 255;
    mask.block(0, 0, 20, 20) = 255;
    writeFile(dir.file(silhouette), encodePng(mask));
    REQUIRE(infer(dir, "in/boy.png --force -o plain --formats layers").exit_code == 0);
    fs::copy(dir.file("plain/boy.layers.png"), dir.file(folder + "/boy.limbs.png"));
    const std::string limbs = ", limbs (" + folder + "/boy.limbs.png)\n";
    for (int time = 0; time < 2; ++time)
      CHECK_THAT(infer(dir, "in/boy.png -o fresh").err,
                 Contains(kTakenUp + std::string("silhouette (") + silhouette + ")" + limbs));
    fs::copy(SKEL_DATASETS "/characters/cap_boy.mask.png", dir.file(folder + "/boy.mask.png"));
    CHECK_THAT(infer(dir, "in/boy.png -o fresh").err,
               Contains(kTakenUp + std::string("mask (") + folder + "/boy.mask.png; not " + silhouette +
                        ", which differs)" + limbs));
  }
}

TEST_CASE("a picture that was renamed after it was labelled left joints, mask and limbs behind") {
  const TempDir dir;
  drawBoy(dir);
  writeFile(dir.file("boy.mask.png"), paintedMask(dir));
  placeInLabels(dir, {300, 300}, "boy.mask.png");
  REQUIRE(infer(dir, "boy.png --formats json,layers").exit_code == 0);
  fs::copy(dir.file("out/boy.layers.png"), dir.file("boy.limbs.png"));
  REQUIRE(infer(dir, "boy.png --formats glb,json -o before").exit_code == 0);
  fs::remove_all(dir.file("out"));
  fs::rename(dir.file("boy.png"), dir.file("ben.png"));
  const auto taken = [](const std::string& folder) {
    const auto made = [&](const std::string& what, const std::string& file) {
      return what + " (" + folder + file + ", made when the picture was called boy.png)";
    };
    return kTakenUp + made("1 joint", "boy.labels.json") + ", " + made("mask", "boy.mask.png") + ", " +
           made("limbs", "boy.limbs.png");
  };
  const auto isAsBefore = [&](const std::string& results) {
    const std::string before = readFile(dir.file("before/boy.glb"));
    return readFile(dir.file(results + ".glb")).size() == before.size() &&
           placeIn(dir, "left_hand", results + ".skeleton.json") == std::vector<double>{300, 300};
  };
  SECTION("alone") {
    CHECK_THAT(infer(dir, "ben.png").err, Contains(taken("")));
    CHECK(isAsBefore("out/ben"));
    CHECK_THAT(infer(dir, "ben.png").err,
               Contains(kTakenUp + std::string("1 joint (out/ben.skeleton.json), mask (boy.mask.png), limbs "
                                               "(boy.limbs.png)\n")));
    CHECK(isAsBefore("out/ben"));
    // Who has left it out under the new name has left it out.
    CHECK_THAT(infer(dir, "ben.png --force").err, !Contains("by hand"));
    CHECK_THAT(infer(dir, "ben.png").err, !Contains("by hand"));
  }
  SECTION("in its folder, with results beside it") {
    CHECK_THAT(infer(dir, ". -o .").err, Contains(taken("./")));
    CHECK(isAsBefore("ben"));
  }
  SECTION("in a list") {
    writeFile(dir.file("list"), "ben.png\n");
    CHECK_THAT(infer(dir, "--from list").err, Contains("ben.png (1 joint (boy.labels.json, made when"));
    CHECK(isAsBefore("out/ben"));
  }
  SECTION("with blank labels of its own, as skel-label candidates makes them") {
    writeLabelFile(dir.file("ben.labels.json"),
                   labelImage(dir.file("ben.png"), std::nullopt, {}, loadTemplate("biped")));
    CHECK_THAT(infer(dir, "ben.png").err, Contains(taken("")));
  }
  SECTION("with labels of its own") {
    LabelFile labels = labelImage(dir.file("ben.png"), std::nullopt, {}, loadTemplate("biped"));
    labels.labels.front() = JointClass::kHead;
    writeLabelFile(dir.file("ben.labels.json"), labels);
    CHECK_THAT(infer(dir, "ben.png").err, !Contains("1 joint (boy.labels.json"));
  }
  SECTION("another picture, and labels that are none") {
    takeAgain(dir, "clown");
    fs::rename(dir.file("boy.png"), dir.file("ben.png"));
    writeFile(dir.file("torn.labels.json"), "{");
    CHECK_THAT(infer(dir, "ben.png").err, !Contains("by hand"));
  }
  SECTION("the picture of that name is there, too") {
    fs::copy(dir.file("ben.png"), dir.file("boy.png"));
    CHECK_THAT(infer(dir, "ben.png").err, !Contains("by hand"));
  }
}

TEST_CASE("a picture that was renamed after joints of its skeleton were moved left them behind") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  const auto [folder, options] = GENERATE(table<std::string, std::string>(
      {{"out", ""}, {"in", " -o in"}, {"in/out", ""}, {"elsewhere", " -o elsewhere"}}));
  CAPTURE(folder);
  REQUIRE(infer(dir, "in/boy.png -o " + folder).exit_code == 0);
  const std::string old_name = folder + "/boy.skeleton.json";
  moveInFile(dir, "left_hand", "420.5", old_name);
  const std::string made = kTakenUp + std::string("1 joint (") + old_name;
  fs::rename(dir.file("in/boy.png"), dir.file("in/ben.png"));
  CHECK_THAT(infer(dir, "in/ben.png" + options).err,
             Contains(made + ", made when the picture was called boy.png)\n"));
  const std::string results = options.empty() ? "out" : folder;
  CHECK(placeIn(dir, "left_hand", results + "/ben.skeleton.json")[0] == 420.5);
  CHECK_THAT(infer(dir, "in/ben.png" + options).err,
             Contains(kTakenUp + std::string("1 joint (") + results + "/ben.skeleton.json)\n"));
  CHECK(placeIn(dir, "left_hand", old_name)[0] == 420.5);
}

TEST_CASE("of two former names of a picture the first in the alphabet counted, not what was mended last") {
  const TempDir dir;
  for (const auto& [name, place] : {std::pair("ann", "420.5"), std::pair("zoe", "430.5")}) {
    const std::string picture = std::string("in/") + name + ".png";
    writeFile(dir.file(picture), readFile(kDrawing));
    REQUIRE(infer(dir, picture).exit_code == 0);
    moveInFile(dir, "left_hand", place, std::string("out/") + name + ".skeleton.json");
    fs::remove(dir.file(picture));
  }
  writeFile(dir.file("in/ben.png"), readFile(kDrawing));
  const auto [newer, older] = GENERATE(table<std::string, std::string>({{"ann", "zoe"}, {"zoe", "ann"}}));
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(dir.file("out/" + newer + ".skeleton.json"), now);
  fs::last_write_time(dir.file("out/" + older + ".skeleton.json"), now - std::chrono::hours(1));
  CHECK_THAT(infer(dir, "in/ben.png").err,
             Contains("1 joint (out/" + newer + ".skeleton.json, made when the picture was called " + newer +
                      ".png)\n"));
}

TEST_CASE(
    "a picture that got another folder, and name, left behind what was mended in its results elsewhere") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  const std::string folder = GENERATE("out", "elsewhere"), made = folder + "/boy.skeleton.json";
  REQUIRE(infer(dir, "in/boy.png -o " + folder).exit_code == 0);
  moveInFile(dir, "left_hand", "420.5", made);
  fs::create_directory(dir.file("class"));
  fs::rename(dir.file("in/boy.png"), dir.file("class/ben.png"));
  CHECK_THAT(
      infer(dir, "class/ben.png -o " + folder).err,
      Contains(kTakenUp + std::string("1 joint (") + made + ", made when the picture was called boy.png)\n"));
}

TEST_CASE("a texture beside a mended skeleton hid it from the picture's new name") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  REQUIRE(infer(dir, "in/boy.png --formats obj,json").exit_code == 0);
  REQUIRE(fs::exists(dir.file("out/boy.png")));
  moveInFile(dir, "left_hand", "420.5");
  fs::rename(dir.file("in/boy.png"), dir.file("in/ben.png"));
  CHECK_THAT(infer(dir, "in/ben.png").err, Contains("1 joint (out/boy.skeleton.json, made when"));
}

TEST_CASE("joints that were moved in the results of a folder were not found in a run over a list, nor back") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  writeFile(dir.file("list"), "in/boy.png\n");
  const auto [first, then, results] = GENERATE(table<std::string, std::string, std::string>(
      {{"in", "--from list", "made/boy"}, {"--from list", "in", "made/in/boy"}}));
  REQUIRE(infer(dir, first + " -o made").exit_code == 0);
  moveInFile(dir, "left_hand", "420.5", results + ".skeleton.json");
  const std::string joint = "1 joint (" + results + ".skeleton.json)";
  CHECK_THAT(infer(dir, then + " -o made").err, Contains("made by hand and taken up") && Contains(joint));
}

TEST_CASE("a picture that was renamed left the mask of a paint program behind without a word") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  REQUIRE(infer(dir, "in/boy.png -o out").exit_code == 0);
  fs::copy(dir.file("out/boy.silhouette.png"), dir.file("in/boy.mask.png"));
  REQUIRE(infer(dir, "in/boy.png -o out").exit_code == 0);
  fs::rename(dir.file("in/boy.png"), dir.file("in/ben.png"));
  CHECK_THAT(infer(dir, "in/ben.png -o out").err,
             Contains("mask (in/boy.mask.png, made when the picture was called boy.png)"));
  fs::rename(dir.file("in/boy.mask.png"), dir.file("in/ben.mask.png"));
  CHECK_THAT(infer(dir, "in/ben.png -o out").err, Contains("mask (in/ben.mask.png)"));
}

TEST_CASE("of two folders with mended joints the first counts, and the line says which one does not") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  for (const std::string folder : {"in", "in/out", "out"}) {
    REQUIRE(infer(dir, "in/boy.png --force -o " + folder).exit_code == 0);
    moveInFile(dir, "left_hand", folder == "out" ? "430" : "420.5", folder + "/boy.skeleton.json");
  }
  const std::string note = "1 joint (in/boy.skeleton.json; not out/boy.skeleton.json, which differs)\n";
  CHECK_THAT(infer(dir, "in/boy.png -o fresh").err, Contains(kTakenUp + note));
  CHECK(placeIn(dir, "left_hand", "fresh/boy.skeleton.json")[0] == 420.5);
  CHECK_THAT(infer(dir, "in/boy.png").err,
             Contains("1 joint (out/boy.skeleton.json; not in/boy.skeleton.json, which differs; not "
                      "in/out/boy.skeleton.json, which differs)\n"));
  CHECK(placeIn(dir, "left_hand")[0] == 430);
}

TEST_CASE("what lies in out/ and belongs to another drawing of that name is not taken up") {
  const TempDir dir;
  writeFile(dir.file("a/boy.png"), readFile(SKEL_DATASETS "/characters/clown.png"));
  writeFile(dir.file("b/boy.png"), readFile(kDrawing));
  REQUIRE(infer(dir, "a/boy.png --formats json,silhouette,layers").exit_code == 0);
  REQUIRE(infer(dir, "b/boy.png -o before").exit_code == 0);
  moveInFile(dir, "left_hand", "300.5");
  fs::copy(dir.file("out/boy.layers.png"), dir.file("out/boy.limbs.png"));
  fs::copy(SKEL_DATASETS "/characters/clown.mask.png", dir.file("out/boy.mask.png"));
  const ToolRun run = infer(dir, "b/boy.png -o after");
  CHECK(run.err.find("mended") == run.err.npos);
  CHECK(run.err.find("by hand") == run.err.npos);
  CHECK(readFile(dir.file("after/boy.glb")) == readFile(dir.file("before/boy.glb")));
  // Masks that nobody says anything of, too.
  fs::remove(dir.file(kSkeleton));
  CHECK(infer(dir, "b/boy.png -o after").err.find("by hand") == std::string::npos);
  SECTION("a drawing that was replaced is spoken of, and nothing beside it is renamed") {
    REQUIRE(infer(dir, "b/boy.png -o b --formats json").exit_code == 0);
    moveInFile(dir, "left_hand", "300.5", "b/boy.skeleton.json");
    writeFile(dir.file("b/boy.png"), readFile(SKEL_DATASETS "/characters/runner.png"));
    const auto before = contentOf(dir, "b");
    CHECK_THAT(infer(dir, "b/boy.png -o new").err, Contains(kEarlier + std::string("boy.skeleton.json\n")));
    CHECK(contentOf(dir, "b") == before);
  }
}

TEST_CASE("when the picture from before is back, no line named the limbs that were painted for it") {
  const TempDir dir;
  drawBoy(dir);
  const std::string call = "boy.png --formats glb,json,layers";
  REQUIRE(infer(dir, call).exit_code == 0);
  const std::string painted = paintOverLeg(dir);
  constexpr const char* kPainted =
      "limbs painted for a picture of this name before, not taken up by themselves: out/boy.old.layers.png "
      "(if it is of this picture, copy it to boy.limbs.png)\n";
  takeAgain(dir, "clown");
  CHECK(infer(dir, call).err.find("not taken up by themselves") == std::string::npos);
  CHECK(infer(dir, call).err.find("not taken up by themselves") == std::string::npos);
  drawBoy(dir);
  CHECK(infer(dir, call + " --force -o other").err.find("not taken up by themselves") == std::string::npos);
  CHECK_THAT(infer(dir, call).err, Contains(kPainted));
  REQUIRE(readFile(dir.file("out/boy.old.layers.png")) == painted);
  fs::copy(dir.file("out/boy.old.layers.png"), dir.file("boy.limbs.png"));
  const ToolRun run = infer(dir, call);
  CHECK_THAT(run.err, Contains("limbs (boy.limbs.png)"));
  CHECK(run.err.find("not taken up by themselves") == std::string::npos);
}

TEST_CASE("when the picture from before is back, a line names the skeleton that was mended for it") {
  const TempDir dir;
  drawBoy(dir);
  REQUIRE(infer(dir, "boy.png").exit_code == 0);
  moveInFile(dir, "left_hand", "420.5");
  takeAgain(dir, "clown");
  constexpr const char* kFits =
      "boy.skeleton.old.json fits this picture: --skeleton out/boy.skeleton.old.json\n";
  REQUIRE(infer(dir, "boy.png").err.find("fits this picture") == std::string::npos);
  drawBoy(dir);
  for (const char* folder : {"out", "fresh"})
    CHECK_THAT(infer(dir, std::string("boy.png -o ") + folder).err, Contains(kFits));
  const std::string sentence = "mended for this very picture before it changed, and not taken up by itself: ";
  const ToolRun quiet = infer(dir, "boy.png --quiet --json");
  CHECK(quiet.err == "boy.png: note: " + sentence + kFits);
  CHECK_THAT(quiet.out, Contains("\"verdict\":\"look at\",\"warnings\":[\"" + sentence));
  CHECK(infer(dir, "boy.png --force").err.find("fits this picture") == std::string::npos);
  const ToolRun back = infer(dir, "boy.png --skeleton out/boy.skeleton.old.json");
  CHECK(back.exit_code == 0);
  CHECK(placeIn(dir, "left_hand")[0] == 420.5);
  CHECK(infer(dir, "boy.png").err.find("fits this picture") == std::string::npos);
}

TEST_CASE("a mistyped joint in labels was said to be of another body plan, to be named by --template") {
  const TempDir dir;
  drawBoy(dir);
  placeInLabels(dir, {300, 300});
  std::string text = readFile(dir.file("boy.labels.json"));
  writeFile(dir.file("boy.labels.json"), text.replace(text.find("\"left_hand\""), 11, "\"left_hnad\""));
  const std::string what = "boy.labels.json: joints.left_hnad: is no joint of the template biped";
  ToolRun run = infer(dir, "boy.png --formats json");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err,
                 "joints placed by hand are left out, as one is of no body plan (mend its name, or name "
                 "its template by --template): " +
                     what + "\n"));
  CHECK_FALSE(contains(run.err, "another body plan"));
  run = infer(dir, "boy.png --formats json -o other --skeleton boy.labels.json");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, what + "; mend its name"));
}

TEST_CASE("labels of another body plan than the nets see ended the run with an error that named no file") {
  const TempDir dir;
  const std::string horse = SKEL_SOURCE_DIR "/datasets/unseen/animals/an3_kid_stick_horse.png";
  writeFile(dir.file("Noah.png"), readFile(horse));
  LabelFile labels = labelImage(dir.file("Noah.png"), std::nullopt, {}, loadTemplate("biped"));
  const Image image = readImage(horse);
  labels.joints = {{"left_hand", Eigen::Vector2d(image.width / 2, image.height / 2)},
                   {"right_hand", std::nullopt}};
  writeLabelFile(dir.file("Noah.labels.json"), labels);
  ToolRun run = infer(dir, "Noah.png --formats json");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err, "taken up: 1 joint (Noah.labels.json)"));
  CHECK(readSkeletonFile(dir.file("out/Noah.skeleton.json"), loadTemplate("biped")).labels);

  run = infer(dir, "Noah.png --formats json -o other --template quadruped");
  CHECK(run.exit_code == 0);
  CHECK(contains(
      run.err,
      "joints placed by hand are a biped's, a quadruped's are asked for: left out (--template biped, "
      "or auto, takes them up): out/Noah.skeleton.json, Noah.labels.json"));
  CHECK_FALSE(hasEditedJoint(dir.file("other/Noah.skeleton.json")));
  run = infer(dir, "Noah.png --formats json --template quadruped");
  CHECK(run.exit_code == 2);
  CHECK(contains(
      run.err,
      "out/Noah.skeleton.json: holds joints of a biped that were moved by hand, a quadruped's are asked "
      "for; give --template biped, name another folder by -o, or lose them by --force"));
  run = infer(dir, "Noah.png --formats json -o third --template quadruped --skeleton Noah.labels.json");
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err,
                 "Noah.labels.json: has joints that are none of the template \"quadruped\"; name theirs"));
}

TEST_CASE("which way a figure looks had to be said in every run") {
  const TempDir dir;
  drawBoy(dir);
  const auto facingOf = [&] { return readSkeletonSource(dir.file(kSkeleton)).facing_deg; };
  const auto looksLeft = [&](const std::string& options) {
    const ToolRun run = infer(dir, "boy.png " + options);
    REQUIRE(run.exit_code == 0);
    return run.out.find("looking left") != std::string::npos;
  };
  CHECK_FALSE(looksLeft(""));
  CHECK_FALSE(facingOf());
  CHECK(looksLeft("--facing boy=-90"));
  CHECK(facingOf() == -90);
  const ToolRun again = infer(dir, "boy.png");
  CHECK_THAT(again.out, Contains("looking left"));
  CHECK_THAT(again.err, Contains(kTakenUp + std::string("which way it looks (out/boy.skeleton.json)")));
  CHECK_FALSE(looksLeft("--facing boy=0"));
  CHECK_FALSE(looksLeft(""));
  CHECK(looksLeft("--facing boy=-90"));
  CHECK_FALSE(looksLeft("--force"));
  CHECK_FALSE(facingOf());
  // Of another photo nobody has said it.
  CHECK(looksLeft("--facing boy=-90"));
  takeAgain(dir, "ninja");
  CHECK_FALSE(looksLeft(""));
}
