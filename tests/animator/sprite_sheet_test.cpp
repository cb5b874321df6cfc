#include "animator/sprite_sheet.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "animator/pixel_look.h"
#include "animator/sprite_camera.h"
#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/oklab.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/import/read_character.h"
#include "libskel/pipeline/posed_character.h"
#include "tests/animator/figure_file.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

const std::string kDrawing = std::string(SKEL_SOURCE_DIR) + "/datasets/characters/dancer.png";
const std::string kDog = std::string(SKEL_SOURCE_DIR) + "/datasets/animals/walking_dog.png";

ToolRun render(const std::string& arguments, const std::string& before = "") {
  return runTool(before + "skel-animate render " + arguments);
}

struct Sheet {
  Image image;
  Json atlas;
};

Sheet sheetOf(const TempDir& dir, const std::string& arguments) {
  const ToolRun run = render(arguments + " --sheet " + dir.file("sheet.png"));
  CHECK(run.err == "");
  REQUIRE(run.exit_code == 0);
  std::ifstream atlas(dir.file("sheet.json"));
  return {readImage(dir.file("sheet.png")), Json::parse(atlas)};
}

int keyOf(const std::uint8_t* p) { return p[0] << 16 | p[1] << 8 | p[2]; }

// One past the lowest row of the frame that is not clear, in the whole cell; 0: all is.
int bottomOf(const Sheet& sheet, const Json& frame) {
  const Json &box = frame["frame"], &in_cell = frame["spriteSourceSize"];
  for (int y = int(box["h"]) - 1; y >= 0; --y)
    for (int x = 0; x < int(box["w"]); ++x)
      if (sheet.image.pixel(int(box["x"]) + x, int(box["y"]) + y)[3] >= 128) return int(in_cell["y"]) + y + 1;
  return 0;
}

// No pixel of the sheet is two frames', and none is outside.
void checkPlaces(const Sheet& sheet) {
  const Json& size = sheet.atlas["meta"]["size"];
  CHECK(size["w"] == sheet.image.width);
  CHECK(size["h"] == sheet.image.height);
  Plane8 taken = Plane8::Zero(sheet.image.height, sheet.image.width);
  for (const Json& frame : sheet.atlas["frames"]) {
    const Json &box = frame["frame"], &in_cell = frame["spriteSourceSize"], &cell = frame["sourceSize"];
    const int x = box["x"], y = box["y"], w = box["w"], h = box["h"];
    REQUIRE((x >= 0 && y >= 0 && w > 0 && h > 0));
    REQUIRE((x + w <= sheet.image.width && y + h <= sheet.image.height));
    CHECK((w == in_cell["w"] && h == in_cell["h"]));
    CHECK((int(in_cell["x"]) + w <= int(cell["w"]) && int(in_cell["y"]) + h <= int(cell["h"])));
    CHECK((taken.block(y, x, h, w) == 0).all());
    taken.block(y, x, h, w) = 1;
  }
}

Image filled(int width, int height, Color color) { return blankImage(width, height, color); }

}  // namespace

TEST_CASE("a sheet of eight directions: frames, tags, durations, pivots on the ground, nothing overlaps") {
  const TempDir dir;
  for (const char* packing : {"", " --trim"}) {
    CAPTURE(packing);
    const Sheet sheet = sheetOf(
        dir, kDrawing + " --directions 8 --clips idle,walk --frames 4 --size 40x48 --pitch 0" + packing);
    checkPlaces(sheet);
    const Json &frames = sheet.atlas["frames"], &tags = sheet.atlas["meta"]["frameTags"];
    REQUIRE(frames.size() == 64);
    REQUIRE(tags.size() == 16);
    CHECK(sheet.atlas["meta"]["image"] == "sheet.png");
    const char* directions[] = {"s", "sw", "w", "nw", "n", "ne", "e", "se"};
    for (int i = 0; i < 16; ++i) {
      CHECK(tags[i]["name"] == std::string(i < 8 ? "idle-" : "walk-") + directions[i % 8]);
      CHECK(tags[i]["from"] == 4 * i);
      CHECK(tags[i]["to"] == 4 * i + 3);
      int duration_ms = 0;
      for (int k = 0; k < 4; ++k) {
        const Json& frame = frames[4 * i + k];
        CHECK(frame["filename"] == std::string(tags[i]["name"]) + "-" + std::to_string(k));
        duration_ms += int(frame["duration"]);
      }
      CHECK(duration_ms == (i < 8 ? 4000 : 1067));
    }
    const Json& pivot = sheet.atlas["meta"]["slices"][0]["keys"][0]["pivot"];
    CHECK(pivot["x"] == 20);
    for (const Json& frame : frames) {
      CHECK(frame["pivot"]["x"] == .5);
      CHECK(double(frame["pivot"]["y"]) == Approx(double(pivot["y"]) / 48));
      CHECK(frame["sourceSize"] == Json({{"w", 40}, {"h", 48}}));
      CHECK(std::abs(bottomOf(sheet, frame) - int(pivot["y"])) <= 1);
      CHECK(frame["trimmed"] == (*packing != 0));
    }
  }
}

TEST_CASE("an atlas is a list, or frames by their names, or by numbers as Phaser's Aseprite loader wants") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  const auto frames = [&](const std::string& form) {
    return sheetOf(dir, model + " --clip nod --frames 2 --size 16 --atlas " + form).atlas["frames"];
  };
  CHECK(frames("array")[1]["filename"] == "nod-1");
  CHECK(frames("hash")["nod-1"]["frame"]["x"] == 16);
  CHECK_FALSE(frames("hash")["nod-1"].contains("filename"));
  CHECK(frames("aseprite")["1"]["duration"] == 500);
}

TEST_CASE(
    "in the pixel look all is opaque or clear, colours are as few as asked for, one dark line is around") {
  const TempDir dir;
  const Sheet sheet =
      sheetOf(dir, kDrawing + " --directions 4 --clips walk --size 48 --pixels --palette 12 --outline");
  checkPlaces(sheet);
  std::set<int> colors;
  for (Eigen::Index i = 0; i < sheet.image.rgba.rows(); ++i) {
    const std::uint8_t* p = sheet.image.rgba.data() + 4 * i;
    REQUIRE((p[3] == 0 || p[3] == 255));
    if (p[3] > 0) colors.insert(keyOf(p));
  }
  CHECK(colors.size() <= 12);
  CHECK(colors.size() > 6);
  // Whoever comes from outside meets the line first.
  std::set<int> first;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x)
      if (const std::uint8_t* p = sheet.image.pixel(x, y); p[3] > 0) {
        first.insert(keyOf(p));
        break;
      }
  CHECK(first.size() == 1);
}

TEST_CASE("a sheet has the same bytes with any number of threads") {
  const TempDir dir;
  const std::string arguments =
      kDog + " --directions 2 --clips walk --frames 6 --size 32 --pixels --palette 8 --sheet ";
  REQUIRE(render(arguments + dir.file("a.png"), "taskset -c 0 ").exit_code == 0);
  REQUIRE(render(arguments + dir.file("b.png")).exit_code == 0);
  CHECK(readFile(dir.file("a.png")) == readFile(dir.file("b.png")));
}

TEST_CASE("an animal that was drawn looking to the left is so in the sprites that look west") {
  const TempDir dir;
  const Sheet as_drawn = sheetOf(dir, kDog + " --clip walk --frames 1 --size 64");
  const Sheet sides = sheetOf(dir, kDog + " --directions 2 --clip walk --frames 1 --size 64");
  CHECK(sides.atlas["frames"][0]["filename"] == "walk-w-0");
  CHECK(sides.atlas["frames"][1]["filename"] == "walk-e-0");
  const auto difference = [&](int y0) {
    double sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        sum += std::abs(sides.image.pixel(x, y0 + y)[3] - as_drawn.image.pixel(x, y)[3]);
    return sum;
  };
  CHECK(difference(0) * 4 < difference(64));
}

TEST_CASE("tags say which motions are played once, the others loop") {
  const TempDir dir;
  const Json tags =
      sheetOf(dir, kDrawing + " --clips walk,wave --frames 1 --size 16").atlas["meta"]["frameTags"];
  CHECK_FALSE(tags[0].contains("repeat"));
  CHECK(tags[1]["repeat"] == "1");
}

TEST_CASE(
    "a motion that travels is shown in place, at the scale of the others, and that is said, but who sways, "
    "sways") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  const auto clip = [&](const std::string& name, double way) {
    writeFile(dir.file(name + ".clip.json"), R"({"format": "skel-clip", "version": 1, "name": ")" + name +
                                                 R"(", "root": [[0, 0, 0, 0], [1, )" + std::to_string(way) +
                                                 R"(, 0, 0], [2, 0, 0.01, 0]],
                 "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [2, 9, 0, 0]]}]})");
    return dir.file(name + ".clip.json");
  };
  const auto sheet = [&](const std::string& clips) {
    const ToolRun run =
        render(model + " --frames 4 --size 48 --clips " + clips + " --sheet " + dir.file("s.png"));
    REQUIRE(run.exit_code == 0);
    return std::pair(readImage(dir.file("s.png")), run.err);
  };
  // 1.63 m tall.
  const std::string stays = clip("stays", 0), goes = clip("goes", 3), sways = clip("sways", .1);
  const Image still = sheet(stays).first;
  const auto [moved, said] = sheet(goes);
  CHECK(said == "figure: note: \"goes\" goes 4.9 m from where it begins; the sheet shows it in place\n");
  CHECK((still.rgba.cast<int>() - moved.rgba.cast<int>()).abs().maxCoeff() <= 8);
  const auto [swaying, nothing] = sheet(sways);
  CHECK(nothing == "");
  CHECK_FALSE((swaying.rgba == still.rgba).all());
}

TEST_CASE("sheets of one run have one scale and one pivot where that is asked for") {
  const TempDir dir;
  const auto pivots = [&](const std::string& options) {
    std::set<int> all;
    std::filesystem::remove_all(dir.file("sheets"));
    const ToolRun run = render(kDrawing + " " + kDog + " --clips idle --frames 1 --size 64 --sheet " +
                               dir.file("sheets/") + options);
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
    for (const char* name : {"dancer", "walking_dog"}) {
      std::ifstream atlas(dir.file("sheets/") + name + ".json");
      all.insert(int(Json::parse(atlas)["meta"]["slices"][0]["keys"][0]["pivot"]["y"]));
    }
    return all;
  };
  const auto height = [&] {
    const Image boy = readImage(dir.file("sheets/dancer.png")),
                dog = readImage(dir.file("sheets/walking_dog.png"));
    const auto rows = [](const Image& image) {
      int count = 0;
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
          if (image.pixel(x, y)[3] > 128) {
            ++count;
            break;
          }
      return count;
    };
    return std::pair(rows(boy), rows(dog));
  };
  pivots("");
  const int alone = height().second;
  CHECK(pivots(" --same-scale").size() == 1);
  const auto [boy, dog] = height();
  CHECK(boy >= 56);
  CHECK(dog < alone);
}

TEST_CASE(
    "a sheet that was made another day had another scale, and --same-scale of one drawing said nothing") {
  const TempDir dir;
  const std::string sheets = dir.file("sheets/");
  REQUIRE(render(kDrawing + " " + kDog +
                 " --clips idle --frames 2 --pitch 20 --size 48x40 --same-scale --sheet " + sheets)
              .exit_code == 0);
  const std::string picture = readFile(sheets + "dancer.png"), atlas = readFile(sheets + "dancer.json");
  const std::string of_idle = kDrawing + " --clips idle --frames 2 --pitch 20";
  const auto isAsBefore = [&](const std::string& arguments, const std::string& sheet) {
    const ToolRun run = render(of_idle + arguments);
    CHECK(run.err == "");
    CHECK(run.exit_code == 0);
    CHECK(readFile(sheet) == picture);
  };
  isAsBefore(" --like " + sheets + "walking_dog.json --sheet " + dir.file("dancer.png"),
             dir.file("dancer.png"));
  CHECK(readFile(dir.file("dancer.json")) == atlas);
  isAsBefore(" --size 48x40 --like " + sheets + "dancer.json --sheet " + sheets, sheets + "dancer.png");
  CHECK(readFile(sheets + "dancer.json") == atlas);

  const ToolRun alone = render(of_idle + " --same-scale --sheet " + dir.file("alone.png"));
  CHECK(alone.exit_code == 0);
  CHECK(
      alone.err ==
      "skel-animate: note: --same-scale does nothing for one drawing; --like SHEET.json takes the scale of a "
      "sheet that is there\n");

  Json narrow = Json::parse(atlas);
  narrow["meta"]["skel"]["pxPerM"] = 40;
  writeFile(dir.file("narrow.json"), narrow.dump());
  const ToolRun cut =
      render(of_idle + " --like " + dir.file("narrow.json") + " --sheet " + dir.file("cut.png"));
  CHECK(cut.exit_code == 0);
  CHECK_THAT(cut.err, Contains("dancer: note: reaches ") && Contains(" px beyond the cell of ") &&
                          Contains("narrow.json (above, in \"idle\"), and is cut off there\n"));

  narrow["meta"].erase("skel");
  writeFile(dir.file("old.json"), narrow.dump());
  const std::string to = " --sheet " + dir.file("none.png") + " --like ";
  const ToolRun old = render(of_idle + to + dir.file("old.json"));
  CHECK(old.exit_code == 2);
  CHECK_THAT(old.err, Contains("old.json: does not say how large a metre is in it"));
  narrow = Json::parse(atlas);
  narrow["meta"]["slices"][0]["keys"].clear();
  writeFile(dir.file("bare.json"), narrow.dump());
  const ToolRun bare = render(of_idle + to + dir.file("bare.json"));
  CHECK(bare.exit_code == 2);
  CHECK_THAT(bare.err, Contains("meta.slices[0].keys") && Contains("must be one, as skel writes it"));
  const ToolRun larger = render(of_idle + " --size 64" + to + sheets + "dancer.json");
  CHECK(larger.exit_code == 1);
  CHECK_THAT(larger.err, Contains("--size is 64, in ") && Contains(" it is 48x40"));
  const ToolRun level = render(kDrawing + " --clips idle" + to + sheets + "dancer.json");
  CHECK(level.exit_code == 1);
  CHECK_THAT(level.err, Contains("--pitch is 5, in ") && Contains("or ask for --pitch 20"));
  CHECK_FALSE(std::filesystem::exists(dir.file("none.png")));
}

TEST_CASE("a sheet that is refused leaves no folder, nor takes away one that was there") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  std::filesystem::create_directory(dir.file("old"));
  CHECK(render(model + " --clip fly --sheet " + dir.file("new/deep/")).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(dir.file("new")));
  CHECK(render(model + " --clip fly --sheet " + dir.file("old/")).exit_code == 1);
  CHECK(std::filesystem::exists(dir.file("old")));
  CHECK(render(model + " --clip nod --frames 1 --sheet " + dir.file("new/deep/S.PNG")).exit_code == 0);
  CHECK(std::filesystem::exists(dir.file("new/deep/S.json")));
}

TEST_CASE("a sheet of skel that was named for a drawing was rigged, as one of its sprites") {
  const TempDir dir;
  const std::string sheet = dir.file("Anna.png");
  const std::string film = sheet + " --clip idle --sheet " + dir.file("x.png");
  for (const char* atlas : {"array", "hash", "aseprite"}) {
    REQUIRE(
        render(figureFile(dir) + " --clip nod --size 24 --atlas " + atlas + " --sheet " + sheet).exit_code ==
        0);
    const ToolRun run = render(film);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains(sheet + ": is a sprite sheet of skel (Anna.json beside it); "));
  }
  // Somebody's own drawing and list, of that name.
  writeFile(sheet, readFile(kDrawing));
  for (const std::string list : {"{", "[]", R"({"meta": {"app": "other", "image": "Anna.png"}})",
                                 R"({"meta": {"app": "skel-animate", "image": "Berta.png"}})"}) {
    writeFile(dir.file("Anna.json"), list);
    CHECK(render(film + " --frames 1 --size 24").exit_code == 0);
  }
}

TEST_CASE("a sheet that was turned by --angle was turned back by the next run without a word") {
  const TempDir dir;
  const std::string made =
      kDrawing + " --clips idle --frames 1 --size 24 --directions 4 --sheet " + dir.file("a.png");
  CHECK(render(made + " --angle 270").err == "");
  CHECK(Json::parse(readFile(dir.file("a.json")))["meta"]["skel"]["angleDeg"] == 270);
  CHECK(render(made).err ==
        "dancer: note: the sheet before was turned by --angle 270, this one by 0; --angle dancer=270 "
        "turns it as before\n");
  CHECK_FALSE(Json::parse(readFile(dir.file("a.json")))["meta"]["skel"].contains("angleDeg"));
  CHECK(render(made).err == "");
}

TEST_CASE("of sheets of several drawings, one alone is turned") {
  const TempDir dir;
  for (const char* name : {"ann.png", "ben.png"}) writeFile(dir.file(name), readFile(kDrawing));
  const std::string made = dir.file("ann.png") + " " + dir.file("ben.png") +
                           " --clips idle --frames 1 --size 24 --directions 4 --sheet " + dir.file("s/");
  const auto angleOf = [&](const char* name) {
    const Json skel = Json::parse(readFile(dir.file(std::string("s/") + name + ".json")))["meta"]["skel"];
    return skel.contains("angleDeg") ? skel["angleDeg"].get<double>() : 0;
  };
  REQUIRE(render(made + " --angle ben=-90").exit_code == 0);
  CHECK(angleOf("ann") == 0);
  CHECK(angleOf("ben") == -90);
  CHECK(readFile(dir.file("s/ann.png")) != readFile(dir.file("s/ben.png")));
  REQUIRE(render(made + " --angle 20,ben=-90,ann=30").exit_code == 0);
  CHECK(angleOf("ann") == 30);
  CHECK(angleOf("ben") == -90);
  REQUIRE(render(made + " --angle ben=30 --angle 30").exit_code == 0);
  CHECK(readFile(dir.file("s/ann.png")) == readFile(dir.file("s/ben.png")));
  for (const auto& [angle, problem] : {std::pair("cat=90", "--angle: no file of this run is called \"cat\""),
                                       std::pair("ben=nan", "--angle: Value nan not in range [-360 - 360]"),
                                       std::pair("ben=", "--angle: Value  not in range [-360 - 360]")}) {
    const ToolRun run = render(made + " --angle " + angle);
    CHECK(run.exit_code == 1);
    CHECK(run.err == "skel-animate: " + std::string(problem) + "\n");
  }
}

TEST_CASE("of several drawings, one alone gets another height") {
  const TempDir dir;
  for (const char* name : {"ann.png", "ben.png"}) writeFile(dir.file(name), readFile(kDrawing));
  const std::string drawings = dir.file("ann.png") + " " + dir.file("ben.png");
  const auto scaleOf = [&](const char* name) {
    return Json::parse(readFile(dir.file(std::string("s/") + name + ".json")))["meta"]["skel"]["pxPerM"]
        .get<double>();
  };
  const std::string made = drawings + " --clips idle --frames 1 --size 24 --sheet " + dir.file("s/");
  REQUIRE(render(made + " --height 1,ben=2").exit_code == 0);
  CHECK(scaleOf("ann") > 1.9 * scaleOf("ben"));
  const ToolRun unknown = render(made + " --height cat=2");
  CHECK(unknown.exit_code == 1);
  CHECK(unknown.err == "skel-animate: --height: no file of this run is called \"cat\"\n");
  REQUIRE(
      runTool("skel-infer " + drawings + " --clips none --height ben=2 -o " + dir.file("out")).exit_code ==
      0);
  const auto modelHeight = [&](const char* name) {
    return heightOf(readGlb(dir.file(std::string("out/") + name + ".glb")).character);
  };
  CHECK(modelHeight("ann") == Approx(1.7).margin(0.01));
  CHECK(modelHeight("ben") == Approx(2).margin(0.01));
  const ToolRun turned =
      render(dir.file("out/ann.glb") + " --clips idle --facing 90 -o " + dir.file("a.gif"));
  CHECK(turned.exit_code == 1);
  CHECK_THAT(turned.err, Catch::Contains("knows which way it looks: make it anew with --facing"));
  const ToolRun model = render(dir.file("out/ann.glb") + " --clips idle --height 2 -o " + dir.file("a.gif"));
  CHECK(model.exit_code == 1);
  CHECK(model.err == "skel-animate: --height is of drawings; " + dir.file("out/ann.glb") +
                         " has its own height: leave --height out\n");
}

TEST_CASE("one drawing changed the scale of all sheets, of those that were there too, without a word") {
  const TempDir dir;
  for (const char* name : {"ann.png", "ben.png"}) writeFile(dir.file(name), readFile(kDrawing));
  const auto sheets = [&](const std::string& drawings) {
    const ToolRun run = runTool("cd '" + dir.path() + "' && skel-animate render " + drawings +
                                " --clips idle --frames 1 --size 48 --same-scale --sheet sheets/");
    CHECK(run.exit_code == 0);
    return run.err;
  };
  const auto pxPerM = [&](const std::string& atlas) {
    return Json::parse(readFile(dir.file("sheets/" + atlas)))["meta"]["skel"]["pxPerM"].get<double>();
  };
  CHECK(sheets("ann.png ben.png") == "");
  const double before = pxPerM("ann.json");
  CHECK(sheets("ann.png ben.png") == "");
  // Another one, who lies.
  Image boy = readImage(kDrawing), lying(boy.height, boy.width);
  for (int y = 0; y < boy.height; ++y)
    for (int x = 0; x < boy.width; ++x) std::copy_n(boy.pixel(x, y), 4, lying.pixel(y, boy.width - 1 - x));
  const std::string name = GENERATE("cat", "aaron");  // which comes first
  writeFile(dir.file(name + ".png"), encodePng(lying));
  const std::string said = sheets(name + ".png ann.png ben.png --upright");
  CHECK_THAT(said, Contains("skel-animate: note: " + name +
                            " reaches farthest and sets the scale of all: a metre is "));
  CHECK_THAT(said,
             Contains(" in the sheets before it was ") && Contains("; --like sheets/ann.old.json makes"));
  CHECK(pxPerM("ann.json") < before);
  CHECK(pxPerM("ann.old.json") == before);
}

TEST_CASE("masks, limbs and backs beside drawings, and sheets of them, were given sheets of their own") {
  const TempDir dir;
  const std::string made = " --clip idle --frames 1 --size 24 --same-scale --sheet ";
  for (const char* name : {"boy.png", "cat.png"}) writeFile(dir.file(name), readFile(kDrawing));
  REQUIRE(render(dir.file("boy.png") + " " + dir.file("cat.png") + made + dir.file("alone/")).exit_code == 0);
  const auto sheets = [&](const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(dir.file(folder)))
      names.insert(entry.path().filename());
    return names;
  };
  REQUIRE(sheets("alone").size() == 4);
  std::string limbs;
  for (const char* ending : {".limbs.png", ".mask.png", ".back.png"}) {
    limbs += " " + dir.file(std::string("cat") + ending);
    writeFile(dir.file(std::string("cat") + ending), readFile(kDrawing));
  }
  REQUIRE(render(dir.file("boy.png") + made + dir.file("boy-sheet.png")).exit_code == 0);
  const std::string sheet = dir.file("boy-sheet.png");
  SECTION("named") {
    const ToolRun run = render(dir.file("boy.png") + " " + dir.file("cat.png") + limbs + " " + sheet +
                               " --force" + made + dir.file("named/"));
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("skel-animate: note: no drawings but what was made of some, left out: "));
    CHECK_THAT(run.err, Contains("boy-sheet.png\n"));
    CHECK(sheets("named") == sheets("alone"));
    CHECK(readFile(dir.file("named/boy.png")) == readFile(dir.file("alone/boy.png")));
  }
  SECTION("by their folder") {
    CHECK(render(dir.path() + " --force" + made + dir.file("folder/")).exit_code == 0);
    CHECK(sheets("folder") == sheets("alone"));
  }
}

TEST_CASE("a sheet of one animation said \"1 animations\"") {
  const TempDir dir;
  const auto said = [&](const std::string& frames) {
    return render(figureFile(dir) + " --clip nod --size 24 --sheet " + dir.file("s.png") + frames).out;
  };
  CHECK_THAT(said(" --frames 1"), Contains(": 1 frame of 24x24, 1 animation, "));
  CHECK_THAT(said(" --frames 2 --directions 4"), Contains(": 8 frames of 24x24, 4 animations, "));
}

TEST_CASE("sheets of several drawings go to a folder, and what makes no sense is one line") {
  const TempDir dir;
  const std::string model = figureFile(dir), sheets = dir.file("sheets/");
  REQUIRE(render(kDrawing + " " + kDog + " --clips idle --frames 2 --size 24 --sheet " + sheets).exit_code ==
          0);
  CHECK(filesBelow(sheets).size() == 4);
  writeFile(dir.file("hero.png"), readFile(kDrawing));
  writeFile(dir.file("long.clip.json"),
            R"({"format": "skel-clip", "version": 1, "name": "long", "duration_s": 120,
               "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0]]}]})");
  const struct {
    std::string arguments, message;
  } cases[] = {
      {dir.file("hero.png") + " --clip idle --sheet " + dir.file("hero.png"),
       "hero.png would be written over, but it is an input; name another output"},
      {model + " --clip nod --sheet " + dir.file("sheet.gif"), "a sprite sheet is a .png"},
      {model + " " + kDrawing + " --clip idle --sheet " + dir.file("sheet.png"), "must be a folder"},
      {model + " --clip nod --sheet a.png -o b.gif", "excludes"},
      {model + " --clip nod -o " + dir.file("a.gif") + " --directions 8", "--directions requires --sheet"},
      {model + " --clip nod --sheet a.png --palette 8", "--palette requires --pixels"},
      {model + " --clip nod --sheet a.png --directions 3", "--directions"},
      {model + " --clip nod --fps 240 --size 2000x2000 --sheet " + dir.file("s.png"),
       "the sheet would be 32000x"},
      {model + " --clip nod --fps 240 --size 2000x2000 --trim --sheet " + dir.file("s.png"),
       "the sheet would be"},
      {model + " --clip " + dir.file("long.clip.json") +
           " --fps 240 --size 1 --directions 16 --trim --sheet " + dir.file("s.png"),
       "a sheet has at most 16384 frames"},
      {model + " --clip nod --size 4000 --sheet " + dir.file("s.png"), "at most 2048 px a side"},
      {model + " --clip nod --look flat --sheet " + dir.file("s.png"), "--look flat is a look of films"},
      {model + " --clips idle walk --sheet " + dir.file("s.png"),
       "there is no file \"walk\"; several clips have commas in between: --clips idle,walk\n"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.arguments);
    const ToolRun run = render(one.arguments);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains(one.message));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
}

TEST_CASE("a pixel is one of the colours of its square, and there only if half of that is covered") {
  Image large = filled(4, 2, kClear);
  const auto put = [&](int x, int y, Color c) {
    std::uint8_t* p = large.pixel(x, y);
    p[0] = c.r, p[1] = c.g, p[2] = c.b, p[3] = c.a;
  };
  const Color red{200, 10, 10}, other{190, 20, 20}, blue{0, 0, 250};
  put(0, 0, red), put(0, 1, other), put(1, 0, red), put(1, 1, blue), put(2, 0, blue);
  const Image small = pixelated(large, 2);
  REQUIRE((small.width == 2 && small.height == 1));
  CHECK(keyOf(small.pixel(0, 0)) == (200 << 16 | 10 << 8 | 10));
  CHECK(int(small.pixel(0, 0)[3]) == 255);
  CHECK(int(small.pixel(1, 0)[3]) == 0);
}

TEST_CASE("a drawing is not written over by a sheet of its name, a sheet is made anew") {
  const TempDir dir;
  writeFile(dir.file("nele.png"), "her drawing");
  const std::string arguments = kDrawing + " --clips idle --frames 1 --sheet " + dir.file("nele.png");
  const ToolRun run = render(arguments);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.err, Contains("nele.png, which is no sheet (there is no nele.json beside it)"));
  CHECK(readFile(dir.file("nele.png")) == "her drawing");
  std::filesystem::remove(dir.file("nele.png"));
  writeFile(dir.file("nele.json"), "{\"my\": \"config\"}");
  CHECK_THAT(render(arguments).err, Contains("nele.json, which is no sheet's: name another file"));
  CHECK(readFile(dir.file("nele.json")) == "{\"my\": \"config\"}");
  std::filesystem::remove(dir.file("nele.json"));
  CHECK(render(arguments).exit_code == 0);
  CHECK(render(arguments).exit_code == 0);
}

TEST_CASE("few colours stand for many, small things keep theirs, and the same ones are in all pictures") {
  std::vector<Image> pictures(2, Image(64, 64));
  for (Image& picture : pictures)
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        std::uint8_t* p = picture.pixel(x, y);
        p[0] = std::uint8_t(200 + x % 8), p[1] = std::uint8_t(150 + y % 8), p[2] = 90, p[3] = 255;
      }
  for (int i = 0; i < 4; ++i)
    std::copy_n(std::array<std::uint8_t, 4>{10, 20, 220, 255}.data(), 4, pictures[0].pixel(i, 9));
  reduceColors(pictures, 3);
  std::set<int> colors;
  for (const Image& picture : pictures)
    for (Eigen::Index i = 0; i < picture.rgba.rows(); ++i) colors.insert(keyOf(picture.rgba.data() + 4 * i));
  CHECK(colors.size() <= 3);
  const std::uint8_t* eye = pictures[0].pixel(2, 9);
  CHECK((eye[0] < 40 && eye[2] > 190));
  const std::vector<Image> before = pictures;
  reduceColors(pictures, 3);
  CHECK((pictures[1].rgba == before[1].rgba).all());
}

TEST_CASE("a sheet takes the colours of a picture, such as a sheet of the day before") {
  const TempDir dir;
  Image colors(4, 1);
  const std::array<std::uint8_t, 12> kThree = {20, 20, 40, 200, 160, 120, 250, 250, 240};
  for (int x = 0; x < 3; ++x) {
    std::copy_n(kThree.data() + 3 * x, 3, colors.pixel(x, 0));
    colors.pixel(x, 0)[3] = 255;
  }
  writeFile(dir.file("three.png"), encodePng(colors));
  const std::string made = kDrawing + " --clips idle --frames 2 --size 32 --pixels --outline --palette ";
  const auto render = [&](const std::string& palette, const std::string& sheet) {
    return runTool("skel-animate render " + made + palette + " --sheet " + dir.file(sheet));
  };
  const Sheet sheet = sheetOf(dir, made + dir.file("three.png"));
  std::set<int> seen, given;
  for (int x = 0; x < 3; ++x) given.insert(keyOf(colors.pixel(x, 0)));
  for (Eigen::Index i = 0; i < sheet.image.rgba.rows(); ++i)
    if (const std::uint8_t* p = sheet.image.rgba.data() + 4 * i; p[3] > 0) seen.insert(keyOf(p));
  CHECK(seen == given);
  // It may be the very sheet that is made anew.
  CHECK(render(dir.file("sheet.png"), "sheet.png").exit_code == 0);
  CHECK((readImage(dir.file("sheet.png")).rgba == sheet.image.rgba).all());
  const ToolRun photo = render(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png", "other.png");
  CHECK(photo.exit_code == 2);
  CHECK_THAT(photo.err, Contains(" colours, a palette at most 256"));
  CHECK_THAT(render("300", "other.png").err, Contains("--palette"));
}

TEST_CASE("OKLab gives back every colour that sRGB has") {
  for (int i = 0; i < 4096; ++i) {
    const Color color{std::uint8_t(i % 16 * 17), std::uint8_t(i / 16 % 16 * 17), std::uint8_t(i / 256 * 17)};
    const Color back = srgbFromOklab(oklabFromSrgb(color));
    CAPTURE(i);
    REQUIRE((back.r == color.r && back.g == color.g && back.b == color.b));
  }
  CHECK(oklabFromSrgb(kWhite)[0] == Approx(1).margin(1e-3));
}

TEST_CASE("one who is drawn from the front looks south when seen from the front") {
  const std::vector<SpriteDirection> directions = spriteDirections(figure(), 4);
  REQUIRE(directions.size() == 4);
  CHECK(directions[0].name == "s");
  CHECK(directions[0].yaw_rad == Approx(0).margin(.1));
  CHECK(directions[1].name == "w");
  CHECK(directions[1].yaw_rad == Approx(std::numbers::pi / 2).margin(.1));
}
