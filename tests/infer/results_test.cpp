// What is written under which name, and which figure of a page it is of.
#include <filesystem>
#include <numbers>

#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/import/read_character.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

bool contains(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

// Figures side by side on white paper, each in its own square.
std::string page(const std::vector<CapsuleFigure>& figures) {
  int width = 0, height = 0;
  for (const CapsuleFigure& figure : figures) width += figure.size, height = std::max(height, figure.size);
  Image image(width, height);
  image.rgba.setConstant(255);
  int left = 0;
  for (const CapsuleFigure& figure : figures) {
    const Image drawn = capsuleImage(figure);
    for (int y = 0; y < drawn.height; ++y)
      for (int x = 0; x < drawn.width; ++x)
        std::copy_n(drawn.pixel(x, y), 4, image.pixel(left + x, height - drawn.height + y));
    left += figure.size;
  }
  return encodePng(image);
}

CapsuleFigure thinStickMan() {
  CapsuleFigure figure;
  figure.size = 320;
  figure.limb_radius = 2;
  figure.trunk_radius = 3;
  figure.head_radius = 18;
  return figure;
}

// page.png, of two figures.
void writePage(const TempDir& dir) {
  CapsuleFigure small;
  small.size = 300;
  writeFile(dir.file("page.png"), page({CapsuleFigure(), small}));
}

}  // namespace

TEST_CASE("where skel takes a figure to look another way, --facing says so, of one drawing of several too") {
  const TempDir dir;
  writeFile(dir.file("ann.png"), page({CapsuleFigure()}));
  writeFile(dir.file("ben.png"), page({CapsuleFigure()}));
  const ToolRun run = infer(dir, "ann.png ben.png --facing 0,ben=-90 --formats glb --json");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.out, "\"facing_deg\":0.0"));
  CHECK(contains(run.out, "\"facing_deg\":-90.0"));
  const auto of = [&](const char* glb) { return readGlb(dir.file(glb)); };
  CHECK(of("out/ann.glb").character.facing->yaw_rad == Approx(0));
  CHECK(of("out/ben.glb").character.facing->yaw_rad == Approx(-std::numbers::pi / 2));
  CHECK(readFile(dir.file("out/ann.glb")) != readFile(dir.file("out/ben.glb")));
  CHECK(
      contains(infer(dir, "ann.png --facing cat=90").err, "--facing: no file of this run is called \"cat\""));
  CHECK(contains(infer(dir, "ann.png --facing nan").err, "--facing"));
}

TEST_CASE("with --ink the line around a drawing with an outline is a hull in its GLB") {
  const TempDir dir;
  writeFile(dir.file("alien.png"), readFile(SKEL_SOURCE_DIR "/datasets/characters/alien.png"));
  REQUIRE(infer(dir, "alien.png --formats glb -o plain").exit_code == 0);
  REQUIRE(infer(dir, "alien.png --formats glb -o ink --ink").exit_code == 0);
  const CharacterFile plain = readGlb(dir.file("plain/alien.glb")), ink = readGlb(dir.file("ink/alien.glb"));
  CHECK_FALSE(plain.ink_hull);
  CHECK(ink.ink_hull);
  CHECK(plain.character.mesh.ink.width_m > 0.005f);
  CHECK(plain.character.mesh.ink.width_m == ink.character.mesh.ink.width_m);
  CHECK(plain.character.mesh.vertices == ink.character.mesh.vertices);
}

TEST_CASE("after --figure all, --skeleton page-2: the second skeleton stays on the second figure") {
  const TempDir dir;
  writePage(dir);
  REQUIRE(infer(dir, "page.png -o one --figure all").exit_code == 0);
  const ToolRun again = infer(dir, "page.png -o two --skeleton one/page-2.skeleton.json");
  CAPTURE(again.err);
  CHECK(again.exit_code == 0);
  CHECK(readFile(dir.file("two/page-2.silhouette.png")) == readFile(dir.file("one/page-2.silhouette.png")));
  CHECK(readFile(dir.file("two/page-2.glb")) == readFile(dir.file("one/page-2.glb")));
  CHECK_FALSE(fs::exists(dir.file("two/page.glb")));
  SECTION("one that is asked for on another figure is refused") {
    const ToolRun run = infer(dir, "page.png -o two --figure 3 --skeleton one/page-2.skeleton.json");
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err,
                   "one/page-2.skeleton.json: belongs to figure 2 of the drawing, --figure asks for 3"));
  }
  SECTION("joints far outside the figure are refused by name") {
    std::string text = readFile(dir.file("one/page-2.skeleton.json"));
    text.replace(text.find("\"number\": 2"), 11, "\"number\": 1");
    writeFile(dir.file("wrong.skeleton.json"), text);
    const ToolRun run = infer(dir, "page.png -o three --skeleton wrong.skeleton.json");
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err, "wrong.skeleton.json: joint \""));
    CHECK(contains(run.err, "\" lies far outside figure 1 of the drawing"));
    CHECK_FALSE(fs::exists(dir.file("three/page.glb")));
  }
}

TEST_CASE("notes of --figure all say which figure") {
  const TempDir dir;
  writePage(dir);
  const ToolRun run = infer(dir, "page.png --figure all");
  CHECK(contains(run.out, "page.png, figure 1: out/page-1.glb"));
  CHECK(contains(run.out, "page.png, figure 2: out/page-2.glb"));
  CHECK_FALSE(contains(run.err, "page.png: note"));
}

TEST_CASE("a mask of the second figure is taken up for that one alone") {
  const TempDir dir;
  writePage(dir);
  REQUIRE(infer(dir, "page.png -o found --figure all --formats json,silhouette").exit_code == 0);
  const Plane8 found = readMask(dir.file("found/page-2.silhouette.png"));
  int top = 0;
  while ((found.row(top) == 0).all()) ++top;
  Plane8 mended = found;
  mended.middleRows(top, 8).setZero();
  const auto run = [&](const std::string& options) {
    return infer(dir, "page.png --formats json,silhouette " + options);
  };
  SECTION("beside the drawing") {
    writeFile(dir.file("page-2.mask.png"), encodePng(mended));
    ToolRun all = run("-o all --figure all");
    CHECK(all.exit_code == 0);
    CHECK(contains(all.err, "figure 2: note: made by hand and taken up: mask (page-2.mask.png)"));
    CHECK((readMask(dir.file("all/page-2.silhouette.png")) == mended).all());
    CHECK(readFile(dir.file("all/page-1.silhouette.png")) ==
          readFile(dir.file("found/page-1.silhouette.png")));
    CHECK(contains(readFile(dir.file("all/page-2.skeleton.json")), "\"number\": 2"));
    CHECK(run("-o two --figure 2").exit_code == 0);
    CHECK((readMask(dir.file("two/page.silhouette.png")) == mended).all());
    CHECK(run("-o again --skeleton all/page-2.skeleton.json").exit_code == 0);
    CHECK((readMask(dir.file("again/page-2.silhouette.png")) == mended).all());
    // It is the mask of another drawing.
    writeFile(dir.file("page-2.png"), page({CapsuleFigure()}));
    all = run("-o other --figure all");
    CHECK(all.exit_code == 0);
    CHECK(readFile(dir.file("other/page-2.silhouette.png")) ==
          readFile(dir.file("found/page-2.silhouette.png")));
  }
  SECTION("painted in place") {
    writeFile(dir.file("found/page-2.silhouette.png"), encodePng(mended));
    const ToolRun all = run("-o found --figure all");
    CHECK(all.exit_code == 0);
    CHECK(contains(all.err,
                   "figure 2: note: made by hand and taken up: silhouette (found/page-2.silhouette.png)"));
    CHECK((readMask(dir.file("found/page-2.silhouette.png")) == mended).all());
  }
}

TEST_CASE("a mask, and joints, that were mended of the largest figure were dropped by --figure all") {
  const TempDir dir;
  writePage(dir);
  REQUIRE(infer(dir, "page.png -o found --figure all --formats json,silhouette").exit_code == 0);
  Plane8 mask = readMask(dir.file("found/page-1.silhouette.png"));
  const auto topOf = [](const Plane8& figure) {
    int row = 0;
    while ((figure.row(row) == 0).all()) ++row;
    return row;
  };
  const int top = topOf(mask);
  mask.middleRows(top, 8).setZero();
  writeFile(dir.file("page.mask.png"), encodePng(mask));
  ToolRun run = infer(dir, "page.png -o mended --figure all --formats json,silhouette");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err, "figure 1: note: made by hand and taken up: mask (page.mask.png)"));
  CHECK(topOf(readMask(dir.file("mended/page-1.silhouette.png"))) == top + 8);
  CHECK(readFile(dir.file("mended/page-2.silhouette.png")) ==
        readFile(dir.file("found/page-2.silhouette.png")));

  // One that joins both leaves nothing beside it.
  const Plane8 other = readMask(dir.file("found/page-2.silhouette.png"));
  Plane8 both = mask.max(other);
  both.middleRows(both.rows() / 2, 12).setConstant(255);
  writeFile(dir.file("page.mask.png"), encodePng(both));
  CHECK(infer(dir, "page.png -o joined --figure all --formats json").exit_code == 0);
  CHECK_FALSE(fs::exists(dir.file("joined/page-2.skeleton.json")));

  writeFile(dir.file("page.mask.png"), encodePng(other));
  run = infer(dir, "page.png -o other --figure all --formats json,silhouette");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err,
                 "made for another figure than the largest, not taken up with --figure all: page.mask.png"));
  CHECK(readFile(dir.file("other/page-1.silhouette.png")) ==
        readFile(dir.file("found/page-1.silhouette.png")));
}

TEST_CASE("who takes all figures is not told that the largest is taken") {
  const TempDir dir;
  writePage(dir);
  CHECK(contains(infer(dir, "page.png --formats json").err, "the largest is taken"));
  CHECK_FALSE(contains(infer(dir, "page.png --formats json --figure all").err, "the largest is taken"));
}

TEST_CASE("a third figure, a thin stick man, is not dropped without a word") {
  const TempDir dir;
  CapsuleFigure small;
  small.size = 340;
  writeFile(dir.file("page.png"), page({CapsuleFigure(), small, thinStickMan()}));
  const ToolRun run = infer(dir, "page.png");
  CHECK(contains(run.err, "the picture shows 3 figures"));
}

TEST_CASE("an edit without \"origin\": \"edited\" is kept, and what was said before it is dropped") {
  const TempDir dir;
  const std::string path = dir.file("out/cap_boy.skeleton.json");
  REQUIRE(infer(dir, kDrawing).exit_code == 0);
  std::string text = readFile(path);
  const size_t hand = text.find("\"left_hand\""), x = text.find("\"image\":[", hand) + 9;
  text.replace(x, text.find(',', x) - x, "420.5");
  text.replace(text.find("\"warnings\": []"), 14, "\"warnings\": [\"this hardly looks like one\"]");
  writeFile(path, text);
  const ToolRun on = infer(dir, kDrawing + " --skeleton out/cap_boy.skeleton.json");
  CHECK(on.exit_code == 0);
  CHECK_FALSE(contains(on.err, "hardly"));
  const std::string after = readFile(path);
  CHECK(contains(after.substr(after.find("\"left_hand\"")), "\"origin\":\"edited\""));
  CHECK_FALSE(contains(after, "hardly"));
}

TEST_CASE("a rest pose is no edit") {
  const TempDir dir;
  REQUIRE(infer(dir, kDrawing + " --rest-pose T").exit_code == 0);
  CHECK(infer(dir, kDrawing + " --rest-pose T").exit_code == 0);
}

TEST_CASE("each format by itself has the bytes that it has among all") {
  const TempDir dir;
  std::string all;
  for (const std::string format :
       {"glb", "json", "overlay", "silhouette", "layers", "features", "obj", "weights", "bvh", "char_cfg"}) {
    REQUIRE(infer(dir, kDrawing + " -o one --formats " + format).exit_code == 0);
    all += (all.empty() ? "" : ",") + format;
  }
  REQUIRE(infer(dir, kDrawing + " -o all --formats " + all).exit_code == 0);
  int files = 0;
  for (const auto& file : fs::recursive_directory_iterator(dir.file("all"))) {
    if (!file.is_regular_file()) continue;
    const std::string name = file.path().lexically_relative(dir.file("all")).string();
    CAPTURE(name);
    CHECK(readFile(dir.file("one/" + name)) == readFile(file.path().string()));
    ++files;
  }
  CHECK(files > 12);
}

TEST_CASE("who asks for the silhouette alone hears nothing of joints, unless results are kept") {
  const TempDir dir;
  const ToolRun run = infer(dir, kDrawing + " --formats silhouette --timings");
  CHECK(contains(run.out, ": out/cap_boy.silhouette.png\n"));
  CHECK_FALSE(contains(run.out, "recognition"));
  const ToolRun kept = infer(dir, kDrawing + " --formats silhouette --json");
  CHECK(contains(kept.out, "\"recognition\""));
  CHECK_FALSE(contains(kept.out, "\"confidence\":0.0,"));
  CHECK_FALSE(contains(kept.out, "\"mesh\""));
}

TEST_CASE("a format without clips says nothing of clips that were asked for") {
  const TempDir dir;
  const std::string asked = kDrawing + " --clips wag";
  CHECK(contains(infer(dir, asked).err, "there is no clip \"wag\""));
  CHECK_FALSE(contains(infer(dir, asked + " --formats json").err, "there is no clip"));
}

TEST_CASE("a clip of one's own that an own template cannot do was said not to be there") {
  const TempDir dir;
  std::string plan = readFile(SKEL_SOURCE_DIR "/libskel/skeleton/templates/biped.json");
  for (const auto& [ours, own] :
       {std::pair<std::string, std::string>("\"biped\"", "\"mine\""), {"\"left_elbow\"", "\"LeftForeArm\""}})
    for (std::size_t at = 0; (at = plan.find(ours, at)) != std::string::npos; at += own.size())
      plan.replace(at, ours.size(), own);
  writeFile(dir.file("mine.json"), plan);
  writeFile(dir.file("clips/bend.clip.json"),
            R"({"format": "skel-clip", "version": 1, "name": "bend", "tracks": [
      {"joint": "right_elbow", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 90]]},
      {"joint": "left_elbow", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 90]]}]})");
  const ToolRun run = infer(dir, kDrawing + " --template mine.json --clips bend --clips-dir clips");
  CHECK(run.exit_code == 1);
  CHECK(run.err == "skel-infer: the clip \"bend\" moves \"left_elbow\", which the template \"mine\" lacks\n");
}

TEST_CASE("a clip of one's own with a misspelt joint is named with the joint, asked for or not") {
  const TempDir dir;
  writeFile(dir.file("clips/flop.clip.json"),
            R"({"format": "skel-clip", "version": 1, "name": "flop", "template": "biped", "tracks": [
      {"joint": "left_sholder", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 90]]}]})");
  const std::string fault =
      "the clip \"flop\" moves \"left_sholder\", which the template \"biped\" lacks; did you mean "
      "\"left_shoulder\"?\n";
  const std::string call = kDrawing + " --formats glb --clips-dir clips";
  const ToolRun asked = infer(dir, call + " --clips idle,flop");
  CHECK(asked.exit_code == 1);
  CHECK(contains(asked.err, "skel-infer: " + fault));
  const ToolRun all = infer(dir, call);
  CHECK(all.exit_code == 0);
  CHECK(contains(all.err, "skel-infer: note: left out: " + fault));
  CHECK(infer(dir, call + " --clips idle").err.find("flop") == std::string::npos);
}

TEST_CASE("option --formats obj reports the .obj, not a .png") {
  const TempDir dir;
  CHECK(contains(infer(dir, kDrawing + " --formats obj").out, ": out/cap_boy.obj  confidence"));
}

TEST_CASE("option --bones says whether the last bones of a GLB have ends") {
  const TempDir dir;
  writeFile(dir.file("a.png"), page({CapsuleFigure()}));
  const auto glb = [&](const std::string& options, const std::string& folder) {
    REQUIRE(infer(dir, "a.png --formats glb -o " + folder + options).exit_code == 0);
    return readFile(dir.file(folder + "/a.glb"));
  };
  const std::string as_ever = glb("", "one");
  const bool same = glb(" --bones along", "two") == as_ever;
  CHECK(same);
  CHECK_FALSE(contains(as_ever, "left_foot_end"));
  CHECK(contains(glb(" --bones ends --names vrm", "three"), "\"leftFoot_end\""));
  CHECK(infer(dir, "a.png --bones up").exit_code == infer(dir, "a.png --names up").exit_code);
}

TEST_CASE("one clip gives <stem>-<clip>.bvh, as the docs say") {
  const TempDir dir;
  CHECK(contains(infer(dir, kDrawing + " --formats bvh --clips wave").out, "out/cap_boy-wave.bvh"));
  CHECK(fs::exists(dir.file("out/cap_boy-wave.bvh")));
  CHECK(infer(dir, kDrawing + " -o still --formats bvh --clips none").exit_code == 0);
  CHECK(fs::exists(dir.file("still/cap_boy.bvh")));
}

TEST_CASE("*.png in the folder of the results does not rig overlays and silhouettes") {
  const TempDir dir;
  writeFile(dir.file("boy.png"), readFile(kDrawing));
  REQUIRE(infer(dir, "boy.png -o .").exit_code == 0);
  const ToolRun again = infer(dir, "*.png -o .");
  CHECK(again.exit_code == 0);
  CHECK(contains(again.err,
                 "note: no drawings but what was made of some, left out: boy.overlay.png, "
                 "boy.silhouette.png\n"));
  CHECK_FALSE(fs::exists(dir.file("boy.overlay.glb")));
  CHECK_FALSE(fs::exists(dir.file("boy.silhouette.glb")));
  fs::remove(dir.file("boy.png"));
  const ToolRun none = infer(dir, "*.png -o .");
  CHECK(none.exit_code == 1);
  CHECK(contains(none.err, "none of the images is a drawing"));
}

TEST_CASE("trace pictures show the steps that the picture needed, and none of a run before") {
  const TempDir dir;
  const std::string drawing = SKEL_DATASETS "/characters/kid_floating_head.png",
                    mask = SKEL_DATASETS "/characters/kid_floating_head.mask.png";
  REQUIRE(infer(dir, drawing + " --formats json --trace t").exit_code == 0);
  for (const char* name : {"2-page-net.png", "2-pieces.png", "7-depth.png"})
    CHECK(fs::exists(dir.file(std::string("t/kid_floating_head/") + name)));
  CHECK_FALSE(fs::exists(dir.file("t/kid_floating_head/2-sheet.png")));
  REQUIRE(infer(dir, drawing + " --formats json --trace t --mask " + mask).exit_code == 0);
  CHECK_FALSE(fs::exists(dir.file("t/kid_floating_head/2-page-net.png")));
}

TEST_CASE("traces of two drawings, one after the other, were mixed in one folder") {
  const TempDir dir;
  for (const char* name : {"cap_boy", "clown"})
    REQUIRE(infer(dir, SKEL_DATASETS "/characters/" + std::string(name) + ".png --formats json --trace t")
                .exit_code == 0);
  CHECK(fs::exists(dir.file("t/cap_boy/summary.png")));
  CHECK(fs::exists(dir.file("t/clown/summary.png")));
  CHECK_FALSE(fs::exists(dir.file("t/summary.png")));
  const ToolRun swallowed = infer(dir, SKEL_DATASETS "/characters/clown.png --trace -o out");
  CHECK(swallowed.exit_code == 1);
  CHECK(swallowed.err == "skel-infer: --trace: needs the name of a folder\n");
}

TEST_CASE("option --version names the version and the hashes of the nets") {
  const TempDir dir;
  const ToolRun run = infer(dir, "--version");
  CHECK(run.exit_code == 0);
  CHECK(run.out.starts_with("skel-infer " SKEL_VERSION "\n"));
  for (const std::string net : {"joint_net", "quadruped_joint_net", "part_net", "page_net"})
    CHECK(contains(run.out, " " + net + " " + sha256(readFile(SKEL_SOURCE_DIR "/weights/" + net + ".bin"))));
}

TEST_CASE("script/build --help makes no folder") {
  for (const std::string argument : {"--help", "--nonsense"}) {
    const ToolRun run = runTool("'" SKEL_SOURCE_DIR "/script/build' " + argument);
    CHECK(run.exit_code == (argument == "--help" ? 0 : 1));
    CHECK_FALSE(fs::exists(SKEL_SOURCE_DIR "/build/" + argument));
  }
}

TEST_CASE("option --back takes plain, same or a picture, and blames a blank one, which is no wrong usage") {
  const TempDir dir;
  for (const std::string back : {"plain", "same"})
    CHECK(infer(dir, kDrawing + " --formats glb -o " + back + " --back " + back).exit_code == 0);
  CHECK(readFile(dir.file("plain/cap_boy.glb")) != readFile(dir.file("same/cap_boy.glb")));
  writeFile(dir.file("behind.png"), page({CapsuleFigure()}));
  CHECK(infer(dir, kDrawing + " --formats glb -o own --back behind.png").exit_code == 0);
  Image white(100, 100);
  white.rgba.setConstant(255);
  writeFile(dir.file("white.png"), encodePng(white));
  const ToolRun none = infer(dir, kDrawing + " -o none --back white.png");
  CHECK(none.exit_code == 2);
  CHECK(contains(none.err, "white.png: "));
  CHECK(infer(dir, kDrawing + " --back nothing.png").exit_code == 2);
}
