#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/silhouette/silhouette.h"
#include "tests/animator/figure_file.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
namespace fs = std::filesystem;

namespace {

ToolRun render(const std::string& arguments) { return runTool("skel-animate render " + arguments); }

const std::string kDrawing = std::string(SKEL_SOURCE_DIR) + "/datasets/characters/dancer.png";

}  // namespace

TEST_CASE("a drawing becomes a film in one command, the same one every time") {
  const TempDir dir;
  const std::string arguments = kDrawing + " --clip dance --duration 0.5 --size 96x128 --fps 12 -o ";
  for (const char* name : {"a.gif", "b.gif", "frames/"}) {
    const ToolRun run = render(arguments + dir.file(name));
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("dancer.png: biped, confidence 0.9"));
    CHECK_THAT(run.out,
               Contains("6 frames of 96x128, 0.50 s of \"dance\"" +
                        std::string(name == std::string("frames/") ? ", as PNG files (a film: -o NAME.mp4)\n"
                                                                   : "\n")));
  }
  CHECK(readFile(dir.file("a.gif")) == readFile(dir.file("b.gif")));
  CHECK(filesBelow(dir.file("frames")).size() == 6);
}

TEST_CASE("a model plays its own clips and those of skel, and looks as it is told") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  const auto frame = [&](const std::string& options) {
    const std::string folder = dir.file("look");
    fs::remove_all(folder);
    const ToolRun run = render(model + " --clip nod --fps 1 --size 64x64 -o " + folder + "/ " + options);
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
    return readImage(folder + "/frame-0001.png");
  };
  const Image plain = frame("");
  CHECK(plain.pixel(0, 0)[0] == 255);
  for (const char* option : {"--wireframe", "--translucent", "--show-skeleton", "--no-shadow", "--angle 40",
                             "--show-weights head", "--background black", "--pitch 30"}) {
    CAPTURE(option);
    CHECK_FALSE((frame(option).rgba == plain.rgba).all());
  }
  CHECK(frame("--background none").pixel(0, 0)[3] == 0);
  CHECK(frame("--background transparent").pixel(0, 0)[3] == 0);
  CHECK(int(frame("--background '#102030'").pixel(0, 0)[2]) == 0x30);
  CHECK(frame("--background " + kDrawing).pixel(0, 0)[3] == 255);
  CHECK(render(model + " --clip walk --fps 4 --size 64x64 -o " + dir.file("walk.webp")).exit_code == 0);
}

TEST_CASE("a model with a drawn line wears it in films and sheets, unless that is not wanted") {
  const TempDir dir;
  RiggedCharacter character = figure();
  character.mesh.ink = {0.02f, {200, 0, 0}};
  writeFile(dir.file("inked.glb"), encodeGlb(character, {nodClip()}));
  const std::string of_nod = dir.file("inked.glb") + " --clip nod --fps 1 ";
  for (const char* to : {"--size 128x128 --angle 90 -o ", "--size 128 --directions 4 --sheet "}) {
    CAPTURE(to);
    const auto made = [&](const std::string& name, const std::string& options) {
      REQUIRE(render(of_nod + options + " " + to + dir.file(name)).exit_code == 0);
      return readImage(fs::is_directory(dir.file(name)) ? dir.file(name) + "/frame-0001.png"
                                                        : dir.file(name));
    };
    const bool sheet = std::string(to).find("sheet") != std::string::npos;
    const auto red = [](const Image& image) {
      return (image.rgba.col(0) > 180 && image.rgba.col(1) < 60 && image.rgba.col(3) == 255).count();
    };
    CHECK(red(made(sheet ? "a.png" : "a/", "")) > red(made(sheet ? "b.png" : "b/", "--no-ink")) + 20);
  }
}

TEST_CASE(
    "several drawings and clips become films in a folder, each character's at one scale and one ground") {
  const TempDir dir;
  const auto films = [&](const std::string& arguments) {
    const ToolRun run = render(arguments + " --fps 5 --size 64x64 --no-shadow --format png -o " + dir.path());
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
  };
  const auto frame = [&](const std::string& film, int number) {
    return readFile(dir.file(film) + "/frame-000" + std::to_string(number) + ".png");
  };
  const std::string dog = std::string(SKEL_SOURCE_DIR) + "/datasets/animals/walking_dog.png";
  films(kDrawing + " " + dog + " --clips idle,walk");
  for (const auto& entry : fs::directory_iterator(dir.path())) CHECK(filesBelow(entry.path()).size() > 4);
  const std::string idle = frame("dancer-idle", 1);
  CHECK(frame("walking_dog-walk", 1) != frame("dancer-walk", 1));
  films(kDrawing + " --clip jump --clip idle");
  CHECK(frame("dancer-idle", 1) == idle);
  films(kDrawing + " --clip idle --frame clips");
  CHECK(frame("dancer-idle", 1) == idle);
  films(kDrawing + " --clips jump,idle --frame clip");
  CHECK(frame("dancer-idle", 1) != idle);

  // Nothing is cut off.
  films(kDrawing + " --clips all --background none");
  for (const std::string& path : filesBelow(dir.path())) {
    if (path.find("dancer") == std::string::npos) continue;
    const Image image = readImage(path);
    for (int i = 0; i < 64; ++i)
      for (const auto& [x, y] : {std::pair(i, 0), {i, 63}, {0, i}, {63, i}})
        REQUIRE(image.pixel(x, y)[3] == 0);
  }
}

TEST_CASE("what a person has mended of a drawing is taken up in films, as skel-infer takes it up") {
  const TempDir dir;
  writeFile(dir.file("boy.png"), readFile(kDrawing));
  const std::string in_folder = "cd '" + dir.path() + "' && ";
  const auto film = [&](const std::string& options, const std::string& note) {
    const ToolRun run =
        runTool(in_folder +
                "skel-animate render boy.png --look solid --clip wave --duration 0.1 --fps 10 --size 64x64 "
                "-o film.gif " +
                options);
    CHECK(run.exit_code == 0);
    CHECK(run.err == (note.empty() ? "" : "boy.png: note: " + note + "\n"));
    return readFile(dir.file("film.gif"));
  };
  const std::string taken_up = "made by hand and taken up: ";
  const std::string drawn = film("", "");

  SECTION("joints that were placed and limbs that were painted, beside the drawing") {
    LabelFile labels;
    labels.image = {"boy.png", sha256(readFile(kDrawing))};
    labels.image_width = labels.image_height = 600;
    labels.grid_width = labels.grid_height = kWorkingGridSize;
    labels.joints = {{"left_hand", Eigen::Vector2d(420, 300)}};
    writeLabelFile(dir.file("boy.labels.json"), labels);
    CHECK(film("", taken_up + "1 joint (boy.labels.json)") != drawn);
    CHECK(film("--force", "") == drawn);
    Image no_limbs(600, 600);
    no_limbs.rgba.setZero();
    writeFile(dir.file("boy.limbs.png"), encodePng(no_limbs));
    CHECK(film("", taken_up + "1 joint (boy.labels.json), limbs (boy.limbs.png)") != drawn);
    SECTION("labels that are named are of this drawing alone") {
      CHECK(film("--force --skeleton boy.labels.json", "") != drawn);
      fs::copy(SKEL_SOURCE_DIR "/datasets/characters/clown.png", dir.file("other.png"));
      const ToolRun other = runTool(in_folder +
                                    "skel-animate render other.png --clip wave --skeleton "
                                    "boy.labels.json -o film.gif");
      CHECK(other.exit_code == 2);
      CHECK_THAT(other.err, Contains("boy.labels.json: was made for another picture than other.png"));
      const ToolRun both = runTool(in_folder +
                                   "skel-animate render boy.png other.png --clip wave --skeleton "
                                   "boy.labels.json -o films/");
      CHECK(both.exit_code == 1);
      CHECK_THAT(both.err, Contains("--skeleton FILE is of one drawing, 2 characters are named"));
    }
  }
  SECTION("a skeleton file among skel-infer's results, there or beside the drawing, or by its name") {
    for (const std::string folder : {"out", "."}) {
      CAPTURE(folder);
      REQUIRE(runTool(in_folder + "skel-infer boy.png --formats json -o " + folder).exit_code == 0);
      CHECK(film("", "") == drawn);
      const std::string path = dir.file(folder + "/boy.skeleton.json");
      std::string text = readFile(path);
      const std::size_t start = text.find("\"image\":[", text.find("\"name\":\"left_hand\"")) + 9;
      text.replace(start, text.find(',', start) - start, "420.5");
      writeFile(path, text);
      const std::string mended =
          film("", taken_up + "1 joint (" + (folder == "." ? "" : folder + "/") + "boy.skeleton.json)");
      CHECK(mended != drawn);
      fs::rename(path, dir.file("named.skeleton.json"));
      CHECK(film("", "") == drawn);
      CHECK(film("--skeleton named.skeleton.json", "") == mended);
    }
  }
}

TEST_CASE("films of a sprite in other colours lost its joints where its silhouette was painted by hand") {
  const TempDir dir;
  Image sprite = readImage(kDrawing);
  Plane8 mask = extractSilhouette(sprite).mask;
  for (Eigen::Index p = 0; p < mask.size(); ++p) sprite.rgba(p, 3) = mask.data()[p];
  writeFile(dir.file("boy.png"), encodePng(sprite));
  mask.bottomRows(mask.rows() / 4).rightCols(mask.cols() / 2) = 0;
  writeFile(dir.file("boy.mask.png"), encodePng(mask));
  const std::string in_folder = "cd '" + dir.path() + "' && ";
  REQUIRE(runTool(in_folder + "skel-infer boy.png --formats json").exit_code == 0);
  const std::string path = dir.file("out/boy.skeleton.json");
  std::string text = readFile(path);
  const std::size_t start = text.find("\"image\":[", text.find("\"name\":\"left_hand\"")) + 9;
  writeFile(path, text.replace(start, text.find(',', start) - start, "420.5"));
  sprite.rgba.col(0).swap(sprite.rgba.col(2));
  writeFile(dir.file("boy.png"), encodePng(sprite));
  const ToolRun run = runTool(in_folder +
                              "skel-animate render boy.png --look solid --clip wave --duration 0.1 --fps 10 "
                              "--size 64x64 -o film.gif");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("1 joint (out/boy.skeleton.json), mask (boy.mask.png)\n"));
  CHECK(run.err.find("earlier picture") == std::string::npos);
}

TEST_CASE("films take up what is mended in out/ beside the drawing, and say what counts where two differ") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  const std::string in_folder = "cd '" + dir.path() + "' && ";
  const auto note = [&](const std::string& options) {
    const ToolRun run = runTool(in_folder +
                                "skel-animate render in/boy.png --clip wave --duration 0.1 --fps 10 --size "
                                "64x64 -o film.gif " +
                                options);
    CHECK(run.exit_code == 0);
    return run.err;
  };
  for (const std::string folder : {"out", "in/out"}) {
    REQUIRE(runTool(in_folder + "skel-infer in/boy.png --force --formats json -o " + folder).exit_code == 0);
    const std::string path = dir.file(folder + "/boy.skeleton.json");
    std::string text = readFile(path);
    const std::size_t start = text.find("\"image\":[", text.find("\"name\":\"left_hand\"")) + 9;
    text.replace(start, text.find(',', start) - start, folder == "out" ? "420.5" : "410.5");
    writeFile(path, text);
    CHECK(note("") == "in/boy.png: note: made by hand and taken up: 1 joint (" + folder +
                          "/boy.skeleton.json" +
                          (folder == "out" ? "" : "; not out/boy.skeleton.json, which differs") + ")\n");
  }
  CHECK(note("--force").empty());
}

TEST_CASE("what was mended in a folder that -o of skel-infer named was left out of films and sheets") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  const std::string in_folder = "cd '" + dir.path() + "' && ";
  const auto mend = [&](const std::string& results) {
    const std::string path = dir.file(results + ".skeleton.json");
    std::string text = readFile(path);
    const std::size_t start = text.find("\"image\":[", text.find("\"name\":\"left_hand\"")) + 9;
    writeFile(path, text.replace(start, text.find(',', start) - start, "420.5"));
  };
  const auto notes = [&](const std::string& options) {
    const ToolRun run =
        runTool(in_folder + "skel-animate render in/boy.png --clip wave --fps 4 --size 16 " + options);
    CHECK(run.exit_code == 0);
    return run.err;
  };
  const std::string taken_up = "in/boy.png: note: made by hand and taken up: ";
  REQUIRE(runTool(in_folder + "skel-infer in/boy.png --formats json -o rigged").exit_code == 0);
  mend("rigged/boy");
  CHECK(notes("-o film.gif").empty());
  CHECK(notes("--results rigged -o film.gif") == taken_up + "1 joint (rigged/boy.skeleton.json)\n");
  CHECK(notes("--results rigged/ --sheet sheet.png") == taken_up + "1 joint (rigged/boy.skeleton.json)\n");
  CHECK(notes("--results rigged --force -o film.gif").empty());
  SECTION("of all figures of a drawing") {
    REQUIRE(runTool(in_folder + "skel-infer in/boy.png --formats json --figure all -o all").exit_code == 0);
    mend("all/boy-1");
    CHECK(notes("--results all -o film.gif") == taken_up + "1 joint (all/boy-1.skeleton.json)\n");
  }
  SECTION("of a list, whose folders it keeps") {
    writeFile(dir.file("list"), "in/boy.png\n");
    REQUIRE(runTool(in_folder + "skel-infer --from list --formats json -o listed").exit_code == 0);
    mend("listed/in/boy");
    CHECK(notes("--results listed -o film.gif") == taken_up + "1 joint (listed/in/boy.skeleton.json)\n");
  }
  SECTION("of a drawing that got another name since") {
    fs::rename(dir.file("rigged/boy.skeleton.json"), dir.file("rigged/ben.skeleton.json"));
    std::string text = readFile(dir.file("rigged/ben.skeleton.json"));
    writeFile(dir.file("rigged/ben.skeleton.json"),
              text.replace(text.find("../in/boy.png"), 13, "../in/ben.png"));
    CHECK(notes("--results rigged -o film.gif") ==
          taken_up + "1 joint (rigged/ben.skeleton.json, made when the picture was called ben.png)\n");
  }
  SECTION("a folder that is not there is said") {
    const ToolRun run =
        render(kDrawing + " --clip wave -o " + dir.file("film.gif") + " --results " + dir.file("none"));
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("none: is no folder"));
  }
}

TEST_CASE("models that are only loaded were said to be fine") {
  const TempDir dir;
  const std::string models = figureFile(dir, "a.glb") + " " + figureFile(dir, "b.glb") + " ",
                    rest = " --fps 4 --size 16 --format gif -o " + dir.file("films/");
  CHECK_THAT(render(models + "--clip nod" + rest).out, EndsWith("\n2 characters\n"));
  CHECK_THAT(render(models + kDrawing + " --clip walk" + rest).out,
             EndsWith("\n3 characters: 1 fine, 2 models\n"));
  writeFile(dir.file("c.glb"), "no model");
  CHECK_THAT(render(models + dir.file("c.glb") + " --clip nod" + rest).out,
             EndsWith("\n3 characters, 1 without a film (" + dir.file("c.glb") + ")\n"));
}

TEST_CASE("a film of one frame said \"1 frames\"") {
  const TempDir dir;
  CHECK_THAT(render(figureFile(dir) + " --clip nod --fps 1 --size 16 -o " + dir.file("film.gif")).out,
             Contains(": 1 frame of 16x16, 1.00 s of \"nod\"\n"));
}

TEST_CASE("why a model of few joints has no clip of skel was said by `list` alone") {
  const TempDir dir;
  RiggedCharacter stick = figure();
  stick.skeleton.template_name.clear();
  for (std::size_t j = 0; j < stick.skeleton.joints.size(); ++j)
    stick.skeleton.joints[j].name = "bone" + std::to_string(j);
  for (Joint& joint : stick.skeleton.joints) joint.parent = std::min(joint.parent, 0);
  writeFile(dir.file("stick.glb"), encodeGlb(stick, {}));
  const ToolRun run = render(dir.file("stick.glb") + " --clip walk -o " + dir.file("film.gif"));
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.err, Contains("there is no clip \"walk\" for this body plan; no clip of skel fits it: "
                               "neither the names of its joints nor their tree tell arms and legs"));
}

TEST_CASE("a clip that is called otherwise than its file was said not to be there") {
  const TempDir dir;
  writeFile(dir.file("clips/wave2.clip.json"),
            R"({"format": "skel-clip", "version": 1, "name": "hello",
      "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 9, 0, 0]]}]})");
  const ToolRun run = render(figureFile(dir) + " --clip wave2 --clips-dir " + dir.file("clips") + " -o " +
                             dir.file("film.gif"));
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.err, EndsWith("there is no clip \"wave2\"; that of " + dir.file("clips/wave2.clip.json") +
                               " is called \"hello\": ask for that, or change its \"name\"\n"));
}

TEST_CASE("a film of a drawing says what skel-infer says of it, once for all films") {
  const TempDir dir;
  const std::string dog =
      std::string(SKEL_SOURCE_DIR) + "/datasets/animals/box_dog.png --template biped --size 64x64 --fps 4 ";
  const ToolRun run = render(dog + "--clips walk,idle --format gif -o " + dir.file("films/"));
  REQUIRE(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("box_dog.png: note: it looks like a quadruped: try --template quadruped"));
  CHECK_THAT(run.err, Contains("this hardly looks like one whole biped; not found: "));
  CHECK_THAT(run.out, Contains("box_dog.png: biped, confidence 0.1"));
  CHECK(run.err.find("looks like a quadruped") == run.err.rfind("looks like a quadruped"));
}

TEST_CASE("for --figure all, which skel-infer takes, no line said what to do instead") {
  const ToolRun run = render(kDrawing + " --figure all --clip walk -o a.gif");
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.err, Contains("--figure: takes one figure; `skel-infer DRAWING --figure all` makes"));
}

TEST_CASE("a film's advice for a figure that is turned named an option that render did not have") {
  const TempDir dir;
  const std::string film = "'" SKEL_SOURCE_DIR
                           "/datasets/unseen/characters/in4_cartwheel_kid.png' --clip idle --fps 1 "
                           "--size 24 -o '" +
                           dir.file("film.gif") + "'";
  const ToolRun turned = render(film);
  REQUIRE(turned.exit_code == 0);
  REQUIRE_THAT(turned.err, Contains("is turned by "));
  REQUIRE_THAT(turned.err, Contains("use --upright"));
  const ToolRun upright = render(film + " --upright");
  CHECK(upright.exit_code == 0);
  CHECK_THAT(upright.err, !Contains("is turned by "));
}

TEST_CASE("several drawings are one film, each in a cell as in a film of its own, at the same time") {
  const TempDir dir;
  const std::string dog = std::string(SKEL_SOURCE_DIR) + "/datasets/animals/walking_dog.png";
  const std::string rest = " --duration 0.8 --fps 5 --size ";
  const auto frame = [&](const std::string& film, int number) {
    return readImage(dir.file(film) + "/frame-000" + std::to_string(number) + ".png");
  };
  const ToolRun run =
      render(kDrawing + " " + dog + " --clip run --together" + rest + "160x80 -o " + dir.file("both/"));
  REQUIRE(run.exit_code == 0);
  CHECK_THAT(run.err, EndsWith("walking_dog.png: note: there is no clip \"run\" for this body plan: "
                               "\"gallop\" instead\n"));
  CHECK_THAT(run.out,
             Contains("4 frames of 160x80, 0.80 s of 2 characters") && EndsWith("2 characters: 2 fine\n"));
  REQUIRE(render(kDrawing + " --clip run" + rest + "80 -o " + dir.file("boy/")).exit_code == 0);
  REQUIRE(render(dog + " --clip gallop" + rest + "80 -o " + dir.file("dog/")).exit_code == 0);
  for (int number = 1; number <= 4; ++number) {
    const Image both = frame("both", number), boy = frame("boy", number), animal = frame("dog", number);
    int most = 0;
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 160; ++x)
        for (int c = 0; c < 3; ++c)
          most = std::max(
              most, std::abs(both.pixel(x, y)[c] - (x < 80 ? boy.pixel(x, y) : animal.pixel(x - 80, y))[c]));
    CHECK(most <= 2);  // of rounding
  }

  // A film's name says so without the option, of a folder, too.
  fs::create_directory(dir.file("class"));
  fs::copy(kDrawing, dir.file("class/J\xc3\xb6rg.png"));
  fs::copy(dog, dir.file("class/dog.png"));
  const std::string film = dir.file("class") + " --clip dance" + rest + "96x64 -o " + dir.file("film.gif");
  REQUIRE(render(film).exit_code == 0);
  const std::string bytes = readFile(dir.file("film.gif"));
  REQUIRE(render(film).exit_code == 0);
  CHECK(readFile(dir.file("film.gif")) == bytes);
  REQUIRE(render(film + " --names").exit_code == 0);
  CHECK(readFile(dir.file("film.gif")) != bytes);
}

TEST_CASE("of several drawings, one that cannot be rigged keeps no other from its film") {
  const TempDir dir;
  writeFile(dir.file("text.png"), "no picture");
  const ToolRun run = render(dir.file("text.png") + " " + kDrawing +
                             " --clip walk --fps 4 --size 64x64 --format gif -o " + dir.file("films/"));
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("text.png: is not a picture"));
  CHECK(filesBelow(dir.file("films")) == std::vector<std::string>{dir.file("films/dancer-walk.gif")});
  CHECK_THAT(run.out, EndsWith("2 characters: 1 fine, 1 without a film (" + dir.file("text.png") + ")\n"));
  const ToolRun together = render(dir.file("text.png") + " " + kDrawing +
                                  " --clip walk --fps 4 --size 64x64 -o " + dir.file("film.gif"));
  CHECK(together.exit_code == 2);
  CHECK_THAT(together.out, Contains("s of 1 character\n"));
}

TEST_CASE(
    "of several drawings, one whose body plan lacks the clip is named, and the others have their films") {
  const TempDir dir;
  const ToolRun run = render(std::string(SKEL_SOURCE_DIR) + "/datasets/animals/box_dog.png " + kDrawing +
                             " --clip run --fps 4 --size 64x64 --format gif -o " + dir.file("films/"));
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.err, Contains("box_dog.png: there is no clip \"run\" for this body plan; did you mean "
                               "\"gallop\"? There are: idle, walk"));
  CHECK(filesBelow(dir.file("films")) == std::vector<std::string>{dir.file("films/dancer-run.gif")});
}

TEST_CASE(
    "of several clips, the one that a drawing's body plan lacks is left out with a note, not the drawing") {
  const TempDir dir;
  const std::string dog = std::string(SKEL_SOURCE_DIR) + "/datasets/animals/box_dog.png ";
  const std::string rest = " --fps 4 --size 32x32 --format gif -o " + dir.file("films/");
  const ToolRun run = render(dog + kDrawing + " --clips 'idle, run'" + rest);
  CHECK(run.exit_code == 0);
  CHECK_THAT(
      run.err,
      Contains("box_dog.png: note: there is no clip \"run\" for this body plan, but \"gallop\": left out\n"));
  CHECK(filesBelow(dir.file("films")).size() == 3);
  // Nor is a word said where what it has instead is asked for, too.
  const ToolRun both = render(dog + kDrawing + " --clips idle,run,gallop" + rest);
  CHECK(both.exit_code == 0);
  CHECK(both.err.find("there is no clip") == std::string::npos);
  CHECK(filesBelow(dir.file("films")).size() == 4);
  // A name that nobody has is wrong.
  const ToolRun wrong = render(dog + kDrawing + " --clips idle,rnu" + rest);
  CHECK(wrong.exit_code == 1);
  CHECK_THAT(wrong.err,
             Contains("dancer.png: there is no clip \"rnu\" for this body plan; there are: idle, walk, run"));
}

TEST_CASE("a clip with a misspelt joint is no film, and the joint is named") {
  const TempDir dir;
  const std::string clip = dir.file("clips/flop.clip.json");
  writeFile(clip, R"({"format": "skel-clip", "version": 1, "name": "flop", "template": "biped", "tracks": [
      {"joint": "left_sholder", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 90]]},
      {"joint": "left_elbow", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 9]]},
      {"joint": "right_shoulder", "angles_deg": [[0, 0, 0, 0], [1, 0, 0, -90]]}]})");
  const std::string lacks =
      "moves \"left_sholder\", which this character lacks; did you mean \"left_shoulder\"?\n";
  const std::string folder = " --clips-dir " + dir.file("clips");
  const std::string film = " --fps 1 --size 16 --format gif -o " + dir.file("films/");
  const std::string model = figureFile(dir), mixamo = dir.file("mixamo.glb");
  writeFile(mixamo, encodeGlb(figure(), {}, {.naming = JointNaming::kMixamo}));
  for (const std::string& figure : {model, kDrawing, mixamo}) {
    CAPTURE(figure);
    const ToolRun by_name = render(figure + " --clips flop" + folder + film);
    CHECK(by_name.exit_code == 1);
    CHECK_THAT(by_name.err, Contains("the clip \"flop\" " + lacks));
    const ToolRun by_path = render(figure + " --clips " + clip + film);
    CHECK(by_path.exit_code == 2);
    CHECK_THAT(by_path.err, Contains(clip + ": " + lacks));
    const ToolRun all = render(figure + " --clips all" + folder + film);
    CHECK(all.exit_code == 0);
    CHECK_THAT(all.err, Contains(figure + ": note: left out: the clip \"flop\" " + lacks));
  }
  for (const std::string& file : filesBelow(dir.file("films"))) CHECK(file.find("flop") == file.npos);
}

// With arms that are one piece with the body.
std::string grownFigureFile(const TempDir& dir) {
  RiggedCharacter grown = figure();
  const int body = grown.skeleton.find("body");
  for (const char* joint :
       {"left_shoulder", "left_elbow", "left_hand", "right_shoulder", "right_elbow", "right_hand"})
    grown.weights.joints = (grown.weights.joints.array() == grown.skeleton.find(joint))
                               .select(std::uint16_t(body), grown.weights.joints.array());
  const std::string model = dir.file("grown.glb");
  writeFile(model, encodeGlb(grown, {}));
  return model;
}

TEST_CASE("a clip of one's own that an arm cannot do is named with the arm") {
  const TempDir dir;
  const std::string model = grownFigureFile(dir);
  writeFile(dir.file("clips/attack.clip.json"),
            R"({"format": "skel-clip", "version": 1, "name": "attack", "template": "biped", "tracks": [
      {"joint": "left_shoulder", "bone": [0, -1, 0], "angles_deg": [[0, 0, 0, 0], [1, 0, 0, 90]]},
      {"joint": "right_shoulder", "bone": [0, -1, 0], "angles_deg": [[0, 0, 0, 0], [1, 0, 0, -90]]}]})");
  const std::string film = " --fps 4 --size 16 -o " + dir.file("film.gif");
  for (const std::string& clip :
       {dir.file("clips/attack.clip.json"), "attack --clips-dir " + dir.file("clips")}) {
    const ToolRun run = render(model + " --clips " + clip + film);
    CHECK(run.exit_code == 0);
    for (const char* arm : {"left", "right"})
      CHECK_THAT(run.err, Contains(model + ": note: the " + std::string(arm) +
                                   " arm is one piece with the body and does not follow \"attack\""));
  }
}

TEST_CASE("a motion that arms cannot do was named of clip files, not of BVH files and not of skel's own") {
  const TempDir dir;
  const std::string model = grownFigureFile(dir),
                    films = " --fps 4 --size 16 --format gif -o " + dir.file("films/");
  const std::string piece = model + ": note: the left arm is one piece with the body and does not follow ";
  const ToolRun own = render(model + " --clips walk,cheer,idle" + films);
  CHECK(own.exit_code == 0);
  CHECK_THAT(own.err, Contains(piece + "\"walk\", \"cheer\"\n"));
  const ToolRun wave = render(model + " --clips wave" + films);
  CHECK_THAT(wave.err, Contains(" arm cannot be moved well and does not do \"wave\"; the trunk rocks\n"));
  const std::string recorded = SKEL_SOURCE_DIR "/tests/data/motions/mixamo.bvh";
  CHECK_THAT(render(model + " --clips " + recorded + films).err, Contains(" arm "));
  CHECK(render(figureFile(dir) + " --clips walk,cheer," + recorded + films).err == "");
}

TEST_CASE("a broken clip file beside the one that is used is one note, an unknown template is said") {
  const TempDir dir;
  const std::string model = figureFile(dir), film = " --fps 4 --size 16 -o " + dir.file("film.gif");
  const std::string clips = " --clips-dir " + dir.file("clips") + film;
  const auto write = [&](const std::string& name, const std::string& body_plan) {
    writeFile(dir.file("clips/" + name + ".clip.json"),
              R"({"format": "skel-clip", "version": 1, "name": ")" + name + R"(", "template": ")" +
                  body_plan +
                  R"(", "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 9, 0, 0]]}]})");
  };
  write("look", "biped");
  write("scan", "robot");
  writeFile(dir.file("clips/broken.clip.json"), "{");
  const ToolRun good = render(model + " --clips look" + clips);
  CHECK(good.exit_code == 0);
  CHECK_THAT(good.err,
             Contains("skel-animate: note: left out: " + dir.file("clips/broken.clip.json") + ": "));
  CHECK(std::count(good.err.begin(), good.err.end(), '\n') == 1);
  CHECK(render(model + " --clips broken" + clips).exit_code == 2);
  const ToolRun all = render(model + " --clips all --clips-dir " + dir.file("clips") +
                             " --size 16 --fps 1 --sheet " + dir.file("sheet/"));
  CHECK(all.exit_code == 0);
  CHECK_THAT(all.err, Contains("skel-animate: note: left out: " + dir.file("clips/broken.clip.json") + ": "));
  const ToolRun robot = render(model + " --clips scan" + clips);
  CHECK(robot.exit_code == 1);
  CHECK_THAT(robot.err, Contains("the clip \"scan\" is made for the template \"robot\", which is not known; "
                                 "there are: biped, quadruped\n"));
}

TEST_CASE("each command's help ends with an example of its own") {
  for (const std::string command : {"info", "list", "bind", "weights", "retarget", "render", "view"}) {
    const ToolRun run = runTool("skel-animate " + command + " --help");
    CHECK_THAT(run.out, Contains("Example: skel-animate " + command + " "));
  }
}

TEST_CASE("a drawing moves as it was drawn, on a ground that is clear, the same one every time") {
  const TempDir dir;
  const std::string arguments =
      kDrawing + " --look flat --clip wave --fps 4 --duration 1 --size 96x96 --background none -o ";
  for (const char* name : {"a/", "b/"}) {
    const ToolRun run = render(arguments + dir.file(name));
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
  }
  const std::string first = dir.file("a/frame-0001.png"), third = dir.file("a/frame-0003.png");
  CHECK(readFile(first) == readFile(dir.file("b/frame-0001.png")));
  CHECK(readFile(third) == readFile(dir.file("b/frame-0003.png")));
  CHECK(readFile(first) != readFile(third));
  CHECK(readImage(first).pixel(0, 0)[3] == 0);
  CHECK((readImage(first).rgba.col(3) == 255).any());
  REQUIRE(render(arguments + dir.file("clips/") + " --frame clips").exit_code == 0);
  CHECK((readImage(dir.file("clips/frame-0001.png")).rgba.col(3) > 0).count() <
        (readImage(first).rgba.col(3) > 0).count());
  const std::string bvh = std::string(SKEL_SOURCE_DIR) + "/tests/data/motions/rokoko.bvh";
  CHECK(render(kDrawing + " --look flat --clip " + bvh + " --fps 4 --size 64x64 -o " + dir.file("bvh.gif"))
            .exit_code == 0);
}

TEST_CASE("two clip files whose clips have one name are refused in films and sheets, and named") {
  const TempDir dir;
  const std::string wave = readFile(SKEL_SOURCE_DIR "/libskel/animation/clips/biped/wave.clip.json");
  std::string other = wave;
  other.replace(other.find("\"flow\""), 6, "\"rest\"");
  const std::string a = dir.file("a/wave.clip.json"), b = dir.file("b/wave.clip.json");
  writeFile(a, wave);
  writeFile(b, other);
  const std::string small = " --size 32 --fps 4 ";
  for (const std::string& output : {"-o " + dir.file("films/"), "--sheet " + dir.file("sheet.png")}) {
    CAPTURE(output);
    const ToolRun run = render(kDrawing + " --clips " + a + "," + b + small + output);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains(a + " and " + b + " are both called \"wave\"; give one of them another"));
    CHECK_FALSE(fs::exists(dir.file("films")));
    CHECK_FALSE(fs::exists(dir.file("sheet.png")));
    CHECK(render(kDrawing + " --clips " + a + "," + a + small + output).exit_code == 0);  // one and the same
    fs::remove_all(dir.file("films"));
    fs::remove(dir.file("sheet.png"));
  }
}

TEST_CASE(
    "a film of a person shows the drawing itself, unless the model is asked for or something it alone has") {
  const TempDir dir;
  const auto frame = [&](const std::string& options) {
    const std::string folder = dir.file("look/");
    fs::remove_all(folder);
    const ToolRun run = render(kDrawing + " --clip wave --fps 1 --size 64x64 -o " + folder + " " + options);
    CHECK(run.err == "");
    REQUIRE(run.exit_code == 0);
    return std::pair(run.out.substr(0, run.out.find('\n')), readFile(folder + "frame-0001.png"));
  };
  const auto [said, drawn] = frame("");
  CHECK_THAT(said, Contains("confidence 0.") && EndsWith(", look flat"));
  CHECK(drawn == frame("--look flat").second);
  CHECK_THAT(frame("--look flat").first, !Contains("look"));
  const std::string model = frame("--look solid").second;
  CHECK(drawn != model);
  for (const char* option :
       {"--wireframe", "--translucent", "--show-weights head", "--angle 40", "--pitch 30", "--blend dual"}) {
    CAPTURE(option);
    const auto [line, with_option] = frame(option);
    CHECK_THAT(line, !Contains("look"));
    CHECK(with_option == frame(std::string(option) + " --look solid").second);
  }
}

TEST_CASE("an arm that lies on the body stays as it is drawn, unless limbs are cut out") {
  const TempDir dir;
  const std::string arm_on_hip = SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png";
  const auto film = [&](const std::string& options) {
    const ToolRun run =
        render(arm_on_hip + " --clip wave --fps 4 --size 64x64 -o " + dir.file("it.gif") + options);
    REQUIRE(run.exit_code == 0);
    return std::pair(readFile(dir.file("it.gif")), run.err);
  };
  const auto [whole, said] = film("");
  CHECK(said == arm_on_hip +
                    ": note: the right arm cannot be moved well and does not do \"wave\"; the left arm "
                    "does (--cut-limbs has it move, and may tear)\n");
  const auto [cut, nothing] = film(" --cut-limbs");
  CHECK(nothing == "");
  CHECK(whole != cut);
  const ToolRun rigged = runTool("skel-infer " + arm_on_hip + " --formats glb -o " + dir.file("out"));
  CHECK_THAT(rigged.err,
             Contains("the right arm lies against the body and stays as it is drawn; --cut-limbs"));
  const ToolRun cut_out =
      runTool("skel-infer " + arm_on_hip + " --cut-limbs --formats glb -o " + dir.file("cut"));
  CHECK(cut_out.err == "");
  CHECK(readFile(dir.file("out/cap_boy.glb")) != readFile(dir.file("cut/cap_boy.glb")));
}

TEST_CASE("a film of an animal, or of a person whose joints are a guess, shows the model, and says so") {
  const TempDir dir;
  const std::string animal = std::string(SKEL_SOURCE_DIR) + "/datasets/animals/cloud_sheep.png";
  const auto filmOf = [&](const std::string& character) {
    const std::string arguments = character + " --clip walk --fps 1 --size 64x64 -o " + dir.file("it.gif");
    const ToolRun run = render(arguments);
    REQUIRE(run.exit_code == 0);
    const std::string film = readFile(dir.file("it.gif"));
    REQUIRE(render(arguments + " --look solid").exit_code == 0);
    CHECK(film == readFile(dir.file("it.gif")));
    return run.out;
  };
  CHECK_THAT(filmOf(animal), Contains(", look solid\n"));
  REQUIRE(runTool("skel-infer " + kDrawing + " --formats json -o " + dir.file("out")).exit_code == 0);
  std::string joints = readFile(dir.file("out/dancer.skeleton.json"));
  const std::size_t at = joints.find("\"confidence\": 0.");
  REQUIRE(at != std::string::npos);
  joints.replace(joints.find("0.", at), 3, "0.2");
  writeFile(dir.file("guess.skeleton.json"), joints);
  CHECK_THAT(filmOf(kDrawing + " --skeleton " + dir.file("guess.skeleton.json")),
             Contains("confidence 0.2") && Contains(", look solid\n"));
}

TEST_CASE("what cannot be rendered is said in one line, and no film is left") {
  const TempDir dir;
  const std::string model = figureFile(dir), film = dir.file("film.gif");
  writeFile(dir.file("text.glb"), "no model");
  writeFile(dir.file("model.xyz"), "no model");
  const struct {
    std::string arguments;
    int exit_code;
    std::string message;
  } cases[] = {
      {"", 1, "file is required"},
      {model + " -o " + film, 1, "--clip is required"},
      {model + " --clip nod", 1, "name the film by -o, or a sprite sheet by --sheet"},
      {model + " --look flat --clip nod -o " + film, 1, "is no drawing"},
      {kDrawing + " --look flat --angle 30 --clip wave -o " + film, 1, "--look flat shows the drawing as it"},
      {model + " --clip fly -o " + film, 1, "there is no clip \"fly\""},
      {model + " --clip none.clip.json -o " + film, 2, "none.clip.json: cannot be read"},
      {model + " --clip nod -o " + dir.file("film.avi"), 1, "films are written as .mp4, .gif, .webp"},
      {model + " --clip nod --size 64x -o " + film, 1, "--size is \"64x\", must be WIDTHxHEIGHT"},
      {model + " --clip nod --size 0x64 -o " + film, 1, "must be WIDTHxHEIGHT"},
      {model + " --clip nod --size 63x64 -o " + dir.file("film.mp4"), 1, "the sides of an MP4 are even"},
      {model + " --clip nod --background none -o " + dir.file("film.mp4"), 1, "MP4 has no transparency"},
      {model + " --clips nod,walk --background none -o " + dir.file("films/"), 1,
       "films/: films in a folder are MP4, which has no transparency, unless --format webp, gif or png"},
      {model + " --clip nod --background '#12' -o " + film, 1, "a colour is written #rrggbb"},
      {model + " --clip nod --background blue.png -o " + film, 2, "blue.png: cannot be read"},
      {model + " --clip nod --size 200000 --background " + kDrawing + " -o " + film, 1,
       "a film of 200000x200000 px cannot be written"},
      {kDrawing + " --figure 2 --clip wave -o " + film, 2, "dancer.png: there is no figure 2, only 1"},
      {model + " --clip nod --show-weights wing -o " + film, 1, "there is no joint \"wing\""},
      {model + " --clips nod,walk -o " + film, 1, "film.gif must be a folder (a name that ends with /)"},
      {model + " " + kDrawing + " --clips nod,walk -o " + film, 1, "film.gif is one film of all drawings"},
      {model + " --clip nod --names -o " + film, 1, "--names is of one film of several drawings"},
      {model + " --clip nod --duration 0 -o " + film, 1, "--duration: Value 0 not in range"},
      {model + " --clip nod --format gif -o " + film, 1, "--format is that of films in a folder"},
      {model + " " + model + " --clip nod -o " + dir.file("films/"), 1,
       "would both write files called figure"},
      {model + " --clip fly -o " + film, 1,
       "; there are: nod, idle, walk, run, jump, wave, dance, sit, cheer, greet, talk\n"},
      {model + " --clip nod --fps 0 -o " + film, 1, "--fps"},
      {model + " --clip nod --fps 60 -o " + film, 1, "at most 50 frames a second"},
      {dir.file("none.glb") + " --clip nod -o " + film, 2, "none.glb: cannot be read"},
      {dir.file("text.glb") + " --clip nod -o " + film, 2, "text.glb"},
      {dir.file("model.xyz") + " --clip nod -o " + film, 2, "is neither a rigged character"},
      {dir.file("none.pgn") + " --clip nod -o " + film, 2, "none.pgn: does not exist"},
      {dir.file("model.fbx") + " --clip nod -o " + film, 2, "is an FBX file; open it in Blender"},
      {dir.file("hero.svg") + " --clip nod -o " + film, 2, "hero.svg -o "},
      {model + " --clip nod -o " + dir.file("text.glb") + "/film.gif", 4, "text.glb"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.arguments);
    const ToolRun run = render(one.arguments);
    CHECK(run.exit_code == one.exit_code);
    CHECK_THAT(run.err, Contains(one.message));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(run.out == "");
  }
  CHECK(filesBelow(dir.path()).size() == 3);
}

TEST_CASE("all clips of a model that can do none are no film and no sheet without sprites") {
  const TempDir dir;
  RiggedCharacter post = figure();
  post.skeleton.joints.resize(1);
  post.weights.joints.setZero();
  const std::string model = dir.file("post.glb");
  writeFile(model, encodeGlb(post, {}));
  for (const std::string& output : {"--sheet " + dir.file("s.png"), "-o " + dir.file("films/")}) {
    const ToolRun run = render(model + " --clip all " + output);
    CHECK(run.exit_code == 2);
    CHECK(run.err ==
          "skel-animate: " + model +
              ": can do no clip: it has none, and none that come with skel fit its joints: neither "
              "the names of its joints nor their tree tell arms and legs, or four legs\n");
  }
}

TEST_CASE("all clips are filmed but the one that this character cannot do, and that is named") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  const auto write = [&](const std::string& name, const std::string& more) {
    writeFile(dir.file("clips/" + name + ".clip.json"),
              R"({"format": "skel-clip", "version": 1, "name": ")" + name + "\", " + more + "}");
  };
  write("sink", R"("contacts": [{"joint": "pelvis", "from_s": 0, "to_s": 1}],
    "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [2, 9, 0, 0]]}])");
  const std::string film =
      " --clip all --clips-dir " + dir.file("clips") + " --fps 1 --size 16 --format gif -o ";
  for (const std::string& figure : {model, kDrawing}) {
    const ToolRun run = render(figure + film + dir.file("films/"));
    CAPTURE(run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Contains(figure + ": note: left out: the clip \"sink\" does not fit its joints\n"));
  }
  CHECK(filesBelow(dir.file("films")).size() == 11 + 10);
  std::string steps;
  for (int i = 0; i < 64; ++i)
    steps += (i ? ", " : "") + std::string(R"({"joint": "left_foot", "from_s": )") + std::to_string(i) +
             R"(, "to_s": )" + std::to_string(i + .5) + "}";
  fs::remove_all(dir.file("clips"));
  write("endless", R"("duration_s": 3600, "contacts": [)" + steps +
                       R"(], "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0]]}])");
  const ToolRun run = render(model + film + dir.file("more/"));
  CAPTURE(run.err);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("skel-animate: " + model + ": the clip \"endless\" is too long: "));
  CHECK(filesBelow(dir.file("more")).size() == 11);
}

TEST_CASE("a disk that fills up leaves no broken film") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  for (const char* name : {"film.mp4", "film.gif", "film.webp"}) {
    CAPTURE(name);
    // The limit stands for the full disk; without the trap it would kill the tool.
    const ToolRun run = runTool("trap '' XFSZ; ulimit -f 2; exec skel-animate render " + model +
                                " --clip nod --size 256x256 -o " + dir.file(name) + " --painter software");
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.err, Contains(std::string(name) + ": cannot be written: File too large"));
  }
  CHECK(filesBelow(dir.path()).size() == 1);
}
