#include <algorithm>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/video/video_writer.h"
#include "stylizer/transfer_motion.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

using namespace skel;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kDrawing = std::string(SKEL_SOURCE_DIR) + "/datasets/characters/cap_boy.png";

ToolRun style(const std::string& arguments) { return runTool("skel-style " + arguments); }

ToolRun done(const std::string& arguments) {
  const ToolRun run = style(arguments);
  CAPTURE(arguments);
  CHECK(run.err == "");
  REQUIRE(run.exit_code == 0);
  return run;
}

// A folder of frames of the drawing, dancing.
std::string film(const TempDir& dir, const std::string& clip) {
  const std::string folder = dir.file(clip + "/");
  const ToolRun run =
      runTool("skel-animate render " + kDrawing + " --clip " + clip +
              " --duration 0.8 --fps 10 --size 160x200 --angle 50 --background none -o " + folder);
  REQUIRE(run.exit_code == 0);
  return folder;
}

// The biped as its preset stands, in frames that go from 0 to `end_s`; none knows the joint `without`.
std::string motionText(int frames, double end_s, double rate, const std::string& without = "") {
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion;
  motion.frame_rate = rate;
  for (int f = 0; f < frames; ++f) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.image_width = frame.image_height = 200;
    frame.time_s = end_s * f / (frames - 1);
    for (const TemplateJoint& joint : plan.joints) {
      frame.joints.emplace_back();
      if (joint.name != without) frame.joints.back() = PlacedJoint{100 * joint.preset.array() + 20, 1};
    }
  }
  return formatMotionFile(motion, plan);
}

// A GIF of ten frames a second.
std::string walkingFilm(const TempDir& dir) {
  const std::string walk = dir.file("walk.gif");
  REQUIRE(runTool("skel-animate render '" SKEL_SOURCE_DIR
                  "/datasets/characters/runner.png' --look solid --clip "
                  "walk --fps 10 --size 64 -o " +
                  walk)
              .exit_code == 0);
  return walk;
}

}  // namespace

TEST_CASE("from a drawing and two films to a new film, and on from what lies between") {
  const TempDir dir;
  const std::string walk = film(dir, "walk"), run = film(dir, "run");
  const std::string make = "make --character " + kDrawing + " --content " + walk + " --style " + run +
                           " --size 160 --fps 10 -o " + dir.file("out.gif");
  CHECK_THAT(done(make).out, Contains("8 frames"));
  const std::string first = readFile(dir.file("out.gif"));
  CHECK_THAT(done(make).out, Contains("content.motion.json: taken as it is"));
  CHECK(readFile(dir.file("out.gif")) == first);
  const std::string content = dir.file("out.gif.work/content.motion.json"),
                    styled = dir.file("out.gif.work/style.motion.json");
  CHECK(done("transfer --content " + content + " --style " + styled + " -o " + dir.file("t.motion.json"))
            .exit_code == 0);
  CHECK(readFile(dir.file("t.motion.json")) == readFile(dir.file("out.gif.work/transfer.motion.json")));
  const std::vector<NamedMotion> walks = readMotions(content), runs = readMotions(styled);
  CHECK(transferMotion(walks, runs).steps);
  std::vector<NamedMotion> dances = walks;  // whose feet keep their distance
  const auto left = std::size_t(loadTemplate("biped").find("left_foot")),
             right = std::size_t(loadTemplate("biped").find("right_foot"));
  for (MotionFrame& frame : dances[0].motion.frames)
    if (frame.joints[left] && frame.joints[right])
      frame.joints[left]->image.x() = frame.joints[right]->image.x() + 20;
  CHECK_FALSE(transferMotion(dances, runs).steps);

  done("render --motion " + dir.file("t.motion.json") + " --to-clip " + dir.file("new.clip.json"));
  CHECK(runTool("skel-animate render " + kDrawing + " --clip " + dir.file("new.clip.json") +
                " --size 64x64 --fps 5 -o " + dir.file("clip.gif"))
            .exit_code == 0);
  done("inspect " + content + " -o " + dir.file("look.png"));
  CHECK(readImage(dir.file("look.png")).width > 400);
  done("render --character " + kDrawing + " --motion " + content +
       " --background keep --in-place --order "
       "left_arm,left_leg,right_leg,body,right_arm -o " +
       dir.file("keep/"));
  CHECK(filesBelow(dir.file("keep")).size() == 8);

  const std::string base = dir.file("base");
  done("database add " + base + " " + content + " --action walk");
  done("database add " + base + " " + styled + " --action run");
  CHECK_THAT(done("database list " + base).out, Contains("walk") && Contains("style.motion.json"));
  CHECK_THAT(done("database check " + base).out, Contains("2 motions, 0 problems"));
  CHECK_THAT(done("fit " + base + " -k 4 --all-frames -o " + dir.file("f.style.json")).out,
             Contains("2 action classes"));
  CHECK(style("database add " + base + " " + content + " --action walk").exit_code == 2);
  writeFile(base + "/content.motion.json", "{}");
  const ToolRun bad = style("database check " + base);
  CHECK(bad.exit_code == 2);
  CHECK_THAT(bad.err, Contains("content.motion.json"));
}

TEST_CASE("what lies in the work folder is taken for the film that it was made of alone, and not lost") {
  const TempDir dir;
  const std::string walk = film(dir, "walk"), run = film(dir, "run");
  const auto make = [&](const std::string& content, const std::string& options = "") {
    return "make --character " + kDrawing + " --content " + content + " --style " + run +
           " --size 96 --fps 10 -o " + dir.file("out.gif") + " " + options;
  };
  const std::string content = dir.file("out.gif.work/content.motion.json"),
                    trace = dir.file("out.gif.work/content.made-of.txt"), taken = "taken as it is";
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    CAPTURE(arguments);
    const std::string before = readFile(content);
    const ToolRun run = style(arguments);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains(message));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(readFile(content) == before);
  };
  done(make(walk));
  const std::string of_walk = readFile(content);
  refused(make(dir.file("none.mp4")), "none.mp4: does not exist");
  refused("make --character " + kDrawing + " --content " + walk + " --style " + dir.file("none.mp4") +
              " --size 96 --fps 10 -o " + dir.file("out.gif"),
          "none.mp4: does not exist");
  // The same name, and other pictures.
  fs::create_directory(dir.file("other"));
  fs::rename(walk, dir.file("other/walk"));
  fs::copy(run, dir.file("walk"));
  const std::string out = done(make(walk)).out;
  CHECK_THAT(out,
             Contains("content.motion.json: 8 frames, made anew") && Contains("style.motion.json: " + taken));
  CHECK(readFile(content) != of_walk);
  CHECK_THAT(done(make(walk)).out, Contains("content.motion.json: " + taken));

  // Mended: kept for this film, not lost for another one.
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion = readMotionFile(content, plan);
  motion.frames[0].joints[0]->origin = JointOrigin::kEdited;
  writeFile(content, formatMotionFile(motion, plan));
  const std::string mended = readFile(content);
  CHECK_THAT(done(make(walk)).out, Contains("content.motion.json: " + taken));
  refused(make(dir.file("other/walk")), "name another folder by --work, or give --force");
  CHECK(readFile(content) == mended);
  // Without a trace, by the film's name.
  fs::remove(trace);
  CHECK_THAT(done(make(walk)).out, Contains("content.motion.json: " + taken));
  refused(make(run), "was mended by hand");
  done(make(dir.file("other/walk"), "--force"));
  CHECK_THAT(done(make(dir.file("other/walk"))).out, Contains("content.motion.json: " + taken));
}

TEST_CASE("frames in a folder were taken for 12 a second without a word") {
  const TempDir dir;
  const std::string idle = film(dir, "idle");
  const auto said = [&](const std::string& options) {
    const ToolRun run = style("keypoints " + idle + options + " -o " + dir.file("a.motion.json"));
    CHECK(run.exit_code == 0);
    return run.err;
  };
  CHECK(said("") == idle + ": note: 12 frames a second assumed; --fps says another\n");
  CHECK(said(" --fps 12") == "");
}

TEST_CASE("of films --fps was ignored without a word") {
  const TempDir dir;
  const std::string walk = walkingFilm(dir);
  for (const std::string& command : {"keypoints " + walk + " -o " + dir.file("a.motion.json"),
                                     "keyframes " + walk + " -o " + dir.file("keys")}) {
    CAPTURE(command);
    CHECK(style(command).err.find("--fps") == std::string::npos);
    const ToolRun run = style(command + " --fps 24");
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err,
               Contains(walk + ": note: a film says itself how many frames a second it has; --fps is "
                               "for folders of frames\n"));
  }
}

TEST_CASE("of films whose motions were there already make ignored --fps without a word") {
  const TempDir dir;
  const std::string walk = walkingFilm(dir);
  const std::string make = "make --character " + kDrawing + " --content " + walk + " --style " + walk +
                           " --size 64 -o " + dir.file("out.gif") + " --work " + dir.file("w");
  REQUIRE(style(make).exit_code == 0);
  const ToolRun again = style(make + " --fps 24");
  CHECK_THAT(again.out, Contains("content.motion.json: taken as it is"));
  CHECK_THAT(again.err, Contains(walk + ": note: a film says itself how many frames a second it has"));
}

TEST_CASE("what was mended of a drawing was left out of its films in another style") {
  const TempDir dir;
  writeFile(dir.file("in/boy.png"), readFile(kDrawing));
  writeFile(dir.file("a.motion.json"), motionText(3, 1, 3));
  const std::string in_folder = "cd '" + dir.path() + "' && ", skeleton = "rigged/boy.skeleton.json";
  REQUIRE(runTool(in_folder + "skel-infer in/boy.png --formats json -o rigged").exit_code == 0);
  std::string text = readFile(dir.file(skeleton));
  const std::size_t start = text.find("\"image\":[", text.find("\"name\":\"left_hand\"")) + 9;
  writeFile(dir.file(skeleton), text.replace(start, text.find(',', start) - start, "420.5"));
  const auto film = [&](const std::string& options) {
    const ToolRun run = runTool(in_folder +
                                "skel-style render --character in/boy.png --motion a.motion.json "
                                "--size 64 -o film.gif " +
                                options);
    CHECK(run.exit_code == 0);
    CHECK(run.err == (options == "--results rigged"
                          ? "in/boy.png: note: made by hand and taken up: 1 joint (" + skeleton + ")\n"
                          : ""));
    return readFile(dir.file("film.gif"));
  };
  const std::string found = film("");
  CHECK(film("--results rigged") != found);
  CHECK(film("--results rigged --force") == found);
  const ToolRun own = runTool(in_folder + "skel-style render --character " + skeleton +
                              " --motion a.motion.json --size 64 -o film.gif --results rigged");
  CHECK(own.exit_code == 1);
  CHECK(own.err == "skel-style: --results is of a drawing, whose mended joints are looked for there; " +
                       skeleton + " has its own: leave --results out\n");
}

TEST_CASE("the background of a model, which has none, was black where it was to be kept") {
  const TempDir dir;
  REQUIRE(runTool("skel-infer " + kDrawing + " -o " + dir.path() + " --formats glb --clips none").exit_code ==
          0);
  const std::string model = dir.file("cap_boy.glb"), motion = dir.file("a.motion.json");
  writeFile(motion, motionText(4, 0.3, 10));
  const ToolRun kept = style("render --character " + model + " --motion " + motion +
                             " --size 96 --background keep -o " + dir.file("keep/"));
  CHECK(kept.exit_code == 0);
  CHECK_THAT(kept.err, Contains(model + ": note: a model has no background to keep\n"));
  CHECK(readImage(dir.file("keep/frame-0001.png")).pixel(0, 0)[3] == 0);
}

TEST_CASE("key frames and the distances of all frames") {
  const TempDir dir;
  const std::string walk = film(dir, "walk");
  CHECK_THAT(done("keyframes " + walk + " --fps 10 --matrix --threshold 0.2 -o " + dir.file("keys")).out,
             Contains("of 8 frames"));
  for (const char* name :
       {"keyframes.json", "distances.json", "distances.png", "key-0001.png", "key-0008.png"})
    CHECK(fs::exists(dir.file("keys") + "/" + name));
}

TEST_CASE("key frames of two films were mixed in one folder") {
  const TempDir dir;
  const auto rectangles = [&](const std::string& name, const std::vector<int>& widths) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      Image image = blankImage(200, 100);
      image.rgba.setZero();
      for (int y = 20; y < 80; ++y)
        for (int x = 20; x < 20 + widths[i]; ++x) image.pixel(x, y)[3] = 255;
      writeFile(dir.file(name + "/" + std::to_string(i) + ".png"), encodePng(image));
    }
  };
  rectangles("one", {20, 80, 22, 24, 26, 28});
  rectangles("other", {20, 22, 24, 90, 26, 28});
  const std::string keys = dir.file("keys");
  const auto names = [&] {
    std::vector<std::string> found;
    for (const std::string& file : filesBelow(keys)) found.push_back(fs::path(file).filename().string());
    return found;
  };
  using Names = std::vector<std::string>;
  done("keyframes " + dir.file("one") + " --matrix -o " + keys);
  const Names of_one = {"distances.json", "distances.png", "key-0001.png",  "key-0002.png",
                        "key-0003.png",   "key-0006.png",  "keyframes.json"};
  REQUIRE(names() == of_one);

  // Nothing is touched where something is not of the earlier run.
  const auto refuses = [&](const std::string& name, const std::string& bytes, const std::string& line,
                           const std::string& options = "") {
    const std::string file = keys + "/" + name, before = fs::exists(file) ? readFile(file) : "";
    writeFile(file, bytes);
    const Names there = names();
    const ToolRun run = style("keyframes " + dir.file("other") + options + " -o " + keys);
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.err, Contains(name + ": " + line));
    CHECK(names() == there);
    CHECK(readFile(file) == bytes);
    before.empty() ? void(fs::remove(file)) : writeFile(file, before);
  };
  refuses("key-0009.png", readFile(keys + "/key-0001.png"), "belongs to another film; remove it");
  refuses("key-0009.png", "mine", "is not one of skel's pictures");
  refuses("keyframes.json", R"({"format": "mine"})", "is not one of skel-style's; move it away");
  refuses("distances.json", "[]", "is not one of skel-style's; move it away");

  writeFile(keys + "/notes.txt", "mine");
  done("keyframes " + dir.file("other") + " -o " + keys);
  CHECK(names() ==
        Names{"key-0001.png", "key-0004.png", "key-0005.png", "key-0006.png", "keyframes.json", "notes.txt"});
  refuses("distances.png", "mine", "is not one of skel-style's; move it away", " --matrix");
  const ToolRun few = style("keyframes " + dir.file("other") + " --threshold 1 -o " + keys);
  CHECK(few.exit_code == 0);
  CHECK(few.err ==
        keys +
            ": note: no frame but the first and the last: successive ones differ by at most 1.00 of "
            "the largest distance; give a --threshold below that\n");
  CHECK(names() == Names{"key-0001.png", "key-0006.png", "keyframes.json", "notes.txt"});
}

TEST_CASE("one frame, frames that are all the same, and frames without a figure") {
  const TempDir dir;
  fs::create_directory(dir.file("one"));
  fs::create_directory(dir.file("same"));
  fs::copy_file(kDrawing, dir.file("one") + "/1.png");
  for (const char* name : {"/1.png", "/2.png", "/3.png"}) fs::copy_file(kDrawing, dir.file("same") + name);
  CHECK_THAT(done("keyframes " + dir.file("one") + " --matrix -o " + dir.file("k1")).out,
             Contains("1 of 1 frames"));
  CHECK_THAT(done("keyframes " + dir.file("same") + " --matrix -o " + dir.file("k3")).out,
             Contains("2 of 3 frames"));
  const std::string one = dir.file("one.motion.json"), same = dir.file("same.motion.json");
  done("keypoints " + dir.file("one") + " --fps 12 -o " + one);
  CHECK_THAT(done("keypoints " + dir.file("same") + " --fps 12 -o " + same).out,
             Contains("unevenness 0.0000"));
  done("transfer --content " + same + " --style " + one + " -o " + dir.file("t.motion.json"));
  CHECK_THAT(done("render --character " + kDrawing + " --motion " + one + " -o " + dir.file("o.gif")).out,
             Contains("1 frames") && Contains("at most 0.0 % of the drawing torn"));

  writeFile(dir.file("blank/1.png"), encodePng(blankImage(64, 64)));
  const ToolRun run = style("keypoints " + dir.file("blank") + " -o " + dir.file("b.motion.json"));
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("shows no figure in any frame"));
  const ToolRun keys = style("keyframes " + dir.file("blank") + " -o " + dir.file("b"));
  CHECK(keys.exit_code == 2);
  CHECK_THAT(keys.err, Contains("shows no figure in any frame"));
}

TEST_CASE("a film of a few bytes whose frames are huge is refused before many of them are in memory") {
  const TempDir dir;
  fs::create_directory(dir.file("film"));
  Image frame(12001, 3000);
  frame.rgba.setConstant(255);
  writeFile(dir.file("film/frame-1.png"), encodePng(frame));
  fs::copy_file(dir.file("film/frame-1.png"), dir.file("film/frame-2.png"));
  const ToolRun run = style("keyframes " + dir.file("film") + " -o " + dir.file("keys"));
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("has frames of 12001x3000 px; 36 million px are the most: scale it down"));
}

TEST_CASE("a motion of more than an hour becomes no clip, and a film in part alone") {
  const TempDir dir;
  writeFile(dir.file("long.motion.json"), motionText(3, 1e6, 1));
  writeFile(dir.file("fast.motion.json"), motionText(3, .001, 1000));
  const std::string film = "render --character " + kDrawing + " --size 64 -o " + dir.file("x.gif") +
                           " --motion ",
                    both = film + dir.file("long.motion.json") + " --duration 1";
  const auto refuses = [](const std::string& arguments, int exit_code, const std::string& message) {
    CAPTURE(arguments);
    const ToolRun run = style(arguments);
    CHECK(run.exit_code == exit_code);
    CHECK_THAT(run.err, Contains(message));
  };
  refuses(film + dir.file("long.motion.json"), 2, "long.motion.json: lasts more than an hour");
  refuses(both + " --to-clip " + dir.file("x.clip.json"), 2, "the clip \"x\" lasts more than an hour");
  refuses(film + dir.file("fast.motion.json"), 1, "a film cannot have 1000.000000 frames a second");
  CHECK(filesBelow(dir.path()).size() == 2);
  CHECK_THAT(done(both).out, Contains("1 frames"));
  CHECK_THAT(done(film + dir.file("fast.motion.json") + " --rate 10").out, Contains("1 frames"));
}

TEST_CASE("of a motion of thousands of frames some are looked at, and too many are not learned from") {
  const TempDir dir;
  const std::string motion = dir.file("m.motion.json");
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile many = readMotionFile((writeFile(motion, motionText(2, 1, 1)), motion), plan);
  const MotionFrame first = many.frames[0];
  many.frames.clear();
  for (int f = 0; f <= 10'000; ++f) {
    many.frames.push_back(first);
    many.frames.back().time_s = f;
    many.frames.back().key = true;
    if (f > 0) std::fill(many.frames.back().joints.begin(), many.frames.back().joints.end(), std::nullopt);
  }
  writeFile(motion, formatMotionFile(many, plan));
  const std::string message = "m.motion.json: has 10001 poses to make a style from; 10000 are the most";
  const std::string twice = "--content " + motion + " --style " + motion;
  for (const std::string& command :
       std::vector<std::string>{"fit " + motion, "fit --all-frames " + motion, "transfer " + twice,
                                "transfer --match signatures " + twice}) {
    CAPTURE(command);
    const ToolRun run = style(command + " -o " + dir.file("x"));
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains(message));
  }
  CHECK_FALSE(fs::exists(dir.file("x")));
  CHECK_THAT(done("inspect --iterations 2 " + motion + " -o " + dir.file("x.png")).out,
             Contains("10001 frames, of which 10000 are factored"));
}

TEST_CASE("a transfer replaced a motion that was mended by hand without a word") {
  const TempDir dir;
  const std::string walk = film(dir, "walk");
  done("keypoints " + walk + " --fps 10 -o " + dir.file("walk.motion.json"));
  const std::string transfer = "transfer --content " + dir.file("walk.motion.json") + " --style " +
                               dir.file("walk.motion.json") + " -o " + dir.file("new.motion.json");
  done(transfer);
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion = readMotionFile(dir.file("new.motion.json"), plan);
  motion.frames[0].joints[0]->origin = JointOrigin::kEdited;
  writeFile(dir.file("new.motion.json"), formatMotionFile(motion, plan));
  const std::string mended = readFile(dir.file("new.motion.json"));
  const ToolRun refused = style(transfer);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Contains("new.motion.json: holds joints that were edited by hand"));
  CHECK(readFile(dir.file("new.motion.json")) == mended);
  done(transfer + " --force");
  CHECK(readFile(dir.file("new.motion.json")) != mended);
}

TEST_CASE("a transfer whose feet are out of step, or whose limbs stay, says so") {
  MotionTransferReport report;
  report.phase_correlation = .95;
  CHECK(transferNotes(report).empty());
  report.phase_correlation = .36;
  CHECK(transferNotes(report).empty());  // a dance keeps no step
  report.steps = true;
  report.still = {"left_foot"};
  const std::vector<std::string> notes = transferNotes(report);
  REQUIRE(notes.size() == 2);
  CHECK_THAT(notes[0], Contains("phase correlation 0.36"));
  CHECK(notes[1] == "left_foot hardly moves, though it does in both");
}

TEST_CASE("no transfer is written that cannot be read again") {
  const TempDir dir;
  const SkeletonTemplate plan = loadTemplate("biped");
  const std::string straight = dir.file("straight.motion.json"), folded = dir.file("folded.motion.json");
  writeFile(straight, motionText(5, 1, 5));
  // Bones as long as the widest frame, folded into it.
  MotionFile zigzag = readMotionFile(straight, plan);
  for (MotionFrame& frame : zigzag.frames) {
    frame.image_width = frame.image_height = 1'000'000;
    for (std::size_t j = 0; j < plan.joints.size(); ++j) {
      const int parent = plan.joints[j].parent;
      const double before = parent < 0 ? 1 : frame.joints[std::size_t(parent)]->image.x();
      frame.joints[j]->image = {before > 0 ? 0 : 999'999, 10.0 * double(j)};
    }
  }
  writeFile(folded, formatMotionFile(zigzag, plan));
  const std::string out = dir.file("t.motion.json");
  const ToolRun run = style("transfer --content " + folded + " --style " + straight + " --loop no -o " + out);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("folded.motion.json: would leave a frame of 1000000 px in this style"));
  CHECK_FALSE(fs::exists(out));
  done("transfer --content " + straight + " --style " + folded + " --loop no -o " + out);
  CHECK_NOTHROW(readMotionFile(out, plan));
}

TEST_CASE("a picture that hundreds of frames name is read once, and pictures may differ in size") {
  const TempDir dir;
  const SkeletonTemplate plan = loadTemplate("biped");
  const std::string motion = dir.file("m.motion.json");
  writeFile(motion, motionText(450, 1, 500));
  MotionFile frames = readMotionFile(motion, plan);
  const auto picture = [&](const std::string& name, int side) {
    Image image = blankImage(side, side);
    fillPolygons(image, {{{.2 * side, .2 * side}, {.4 * side, .8 * side}, {.7 * side, .3 * side}}}, kInk);
    writeFile(dir.file(name), encodePng(image));
  };
  picture("large.png", 3000);
  picture("small.png", 200);
  for (MotionFrame& frame : frames.frames) frame.image_file = "large.png", frame.key = true;
  writeFile(motion, formatMotionFile(frames, plan));
  // Each by itself, 450 times, would take minutes.
  done("inspect --iterations 2 " + motion + " -o " + dir.file("one.png"));
  frames.frames[7].image_file = "small.png";
  writeFile(motion, formatMotionFile(frames, plan));
  done("inspect --iterations 2 " + motion + " -o " + dir.file("two.png"));
}

TEST_CASE("a database takes no motion that no command could use") {
  const TempDir dir;
  writeFile(dir.file("m.motion.json"), motionText(2, 1, 1, "head"));
  const ToolRun run =
      style("database add " + dir.file("db") + " " + dir.file("m.motion.json") + " --action a");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("m.motion.json: no frame knows the joint \"head\""));
  CHECK_FALSE(fs::exists(dir.file("db")));
}

TEST_CASE("a database lists a motion once, and none that is named as its index") {
  const TempDir dir;
  writeFile(dir.file("index.json"), motionText(2, 1, 1));
  const std::string db = dir.file("db");
  ToolRun run = style("database add " + db + " " + dir.file("index.json") + " --action a");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("index.json: is named as the database's own index; rename it"));

  fs::rename(dir.file("index.json"), dir.file("m.motion.json"));
  done("database add " + db + " " + dir.file("m.motion.json") + " --action a");
  std::string index = readFile(db + "/index.json");
  const std::size_t from = index.find('{', index.find("motions")), to = index.find('}', from);
  writeFile(db + "/index.json", index.insert(to + 1, "," + index.substr(from, to + 1 - from)));
  run = style("database list " + db);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("motions[1].file: stands there twice"));
}

TEST_CASE("a film's pictures are written when a figure is found in it, and not before") {
  const TempDir dir;
  const auto video = openVideo(dir.file("blank.gif"), {.width = 64, .height = 64, .frame_rate = 10});
  for (int i = 0; i < 3; ++i) video->add(blankImage(64, 64));
  video->finish();
  const ToolRun run = style("keypoints " + dir.file("blank.gif") + " -o " + dir.file("b.motion.json"));
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("shows no figure in any frame"));
  CHECK(filesBelow(dir.path()).size() == 1);

  REQUIRE(runTool("skel-animate render " + kDrawing +
                  " --clip walk --duration 0.3 --fps 10 --size "
                  "160x200 -o " +
                  dir.file("walk.gif"))
              .exit_code == 0);
  done("keypoints " + dir.file("walk.gif") + " -o " + dir.file("w.motion.json"));
  CHECK(filesBelow(dir.file("w.frames")).size() == 3);
  done("inspect " + dir.file("w.motion.json") + " -o " + dir.file("w.png"));
}

TEST_CASE("what cannot be done is said in one line, and nothing is written") {
  const TempDir dir;
  writeFile(dir.file("bad.motion.json"), "{\"format\": \"skel-motion\", \"version\": 9}");
  fs::create_directory(dir.file("empty"));
  const std::string out = " -o " + dir.file("x.gif");
  const TempDir frames;
  fs::copy(kDrawing, frames.file("1.png"));
  const std::string films = " --content " + frames.path() + " --style " + frames.path();
  const struct {
    std::string arguments;
    int exit_code;
    std::string message;
  } cases[] = {
      {"", 1, "subcommand"},
      {"keyframes " + dir.file("none.mp4"), 2, "none.mp4: does not exist"},
      {"keyframes " + dir.file("empty") + " -o " + dir.file("empty"), 1, "empty holds the frames"},
      {"keypoints " + dir.file("empty"), 2, "holds no pictures"},
      {"keypoints " + dir.file("bad.motion.json"), 2, "cannot be read as a film"},
      {"inspect " + dir.file("bad.motion.json"), 2, "bad.motion.json: version: is 9"},
      {"inspect " + dir.file("none.motion.json"), 2, "none.motion.json: cannot be read"},
      {"transfer --content " + dir.file("empty") + " --style x", 2, "empty: is no database"},
      {"fit " + dir.file("empty"), 2, "empty: is no database"},
      {"database list " + dir.file("empty"), 2, "empty: is no database: it has no index.json"},
      {"database check " + dir.file("empty"), 2, "empty: is no database: it has no index.json"},
      {"make --character " + dir.file("none.glb") + films + out, 2, "none.glb: cannot be read"},
      {"make --character " SKEL_SOURCE_DIR "/datasets/animals/cloud_sheep.png" + films + out, 2,
       "cloud_sheep.png: is a quadruped's figure, and these motions are a person's"},
      {"make --character " + kDrawing + films + " --order head" + out, 1, "--order names each part once"},
      {"make --character " + kDrawing + films + " --background '#12'" + out, 1,
       "a colour is written #rrggbb"},
      {"make --character " + kDrawing + films + " --background " + dir.file("none.png") + out, 2,
       "none.png: cannot be read"},
      {"render --motion " + dir.file("bad.motion.json") + " --to-clip " + dir.file("clip"), 2,
       "version: is 9"},
      {"render --motion m.motion.json", 1, "name a film by -o"},
      {"render --motion m.motion.json" + out, 1, "needs --character"},
      {"render --character " + kDrawing + " --motion " + dir.file("bad.motion.json") + out, 2,
       "version: is 9"},
      {"make --character " + dir.file("none.png") + films + out, 2, "none.png: cannot be read"},
      {"make --character " + kDrawing + " --content a.mp4 --style b" + out, 2, "a.mp4: does not exist"},
      {"make --character " + kDrawing + " --content " + frames.path() + " --style b.mp4" + out, 2,
       "b.mp4: does not exist"},
      {"make --character " + kDrawing + " --content " + frames.path() + out, 1, "--style is required"},
      {"make --character " + kDrawing + films + " -o " + dir.file("x.avi"), 1, "films are written as"},
      {"database list " + dir.file("none"), 2, "is no folder"},
      {"database add " + dir.file("empty"), 1, "name the motion files"},
      {"fit " + dir.file("bad.motion.json") + " -k 0", 1, "--components"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.arguments);
    const ToolRun run = style(one.arguments);
    CHECK(run.exit_code == one.exit_code);
    CHECK_THAT(run.err, Contains(one.message));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
  CHECK(filesBelow(dir.path()).size() == 1);
}

TEST_CASE("make with a wrong style worked through the content first, and left its work folder") {
  const TempDir dir;
  fs::create_directory(dir.file("film"));
  fs::copy(kDrawing, dir.file("film/1.png"));
  writeFile(dir.file("bad.motion.json"), "{}");
  for (const char* wrong : {"none.mp4", "none.motion.json", "bad.motion.json"}) {
    const ToolRun run = style("make --character " + kDrawing + " --content " + dir.file("film") +
                              " --style " + dir.file(wrong) + " -o " + dir.file("out.gif"));
    CHECK(run.exit_code == 2);
    CHECK(run.out == "");
    CHECK_THAT(run.err, Contains(wrong));
  }
  CHECK_FALSE(fs::exists(dir.file("out.gif.work")));
}

TEST_CASE("a film in place of a motion was said to be no JSON") {
  const TempDir dir;
  const std::string frames = film(dir, "idle"), gif = dir.file("idle.gif");
  REQUIRE(runTool("skel-animate render " + kDrawing + " --clip idle --fps 2 --size 64 -o " + gif).exit_code ==
          0);
  const auto told = [&](const std::string& arguments, const std::string& path) {
    const ToolRun run = style(arguments + " -o " + dir.file("out.json"));
    CAPTURE(arguments);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("skel-style: " + path + ": is a film, no motion; `skel-style keypoints " +
                                 path + " -o " + dir.file("idle") + ".motion.json` makes one of it\n"));
  };
  for (const std::string& path : {gif, frames}) {
    told("transfer --content " + path + " --style " + path, path);
    told("fit " + path, path);
  }
  told("render --motion " + gif + " --character " + kDrawing, gif);
  writeFile(dir.file("a.motion.json"), "{");
  CHECK_THAT(style("fit " + dir.file("a.motion.json") + " -o " + dir.file("out.json")).err,
             Contains("is not JSON"));
}

TEST_CASE("a film of an animal was taken for a person's without a word") {
  const TempDir dir;
  fs::create_directory(dir.file("sheep"));
  for (const char* frame : {"1", "2", "3"})
    fs::copy(SKEL_SOURCE_DIR "/datasets/animals/cloud_sheep.png",
             dir.file(std::string("sheep/") + frame + ".png"));
  const std::string note =
      dir.file("sheep") + ": note: shows a quadruped's figure, and these motions are a person's";
  const ToolRun found = style("keypoints " + dir.file("sheep") + " -o " + dir.file("s.motion.json"));
  CHECK(found.exit_code == 0);
  CHECK(found.err.starts_with(note));
  const ToolRun made = style("make --character " + kDrawing + " --content " + dir.file("sheep") +
                             " --style " + film(dir, "walk") + " --size 64 -o " + dir.file("out.gif"));
  CHECK(made.exit_code == 0);
  CHECK(made.err.starts_with(note));
}

TEST_CASE("a folder in place of the motion file is told from a motion, as with every output") {
  const TempDir dir;
  const std::string walk = film(dir, "walk");
  fs::create_directories(dir.file("there"));
  for (const std::string command : {"skel-style keypoints ", "skel-label motion "}) {
    const ToolRun run = runTool(command + walk + " -o " + dir.file("there"));
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.err, Contains("there: is a folder; name a file by -o"));
  }
}

TEST_CASE("key frames of a film that holds no pictures leave no folder behind") {
  const TempDir dir;
  fs::create_directories(dir.file("empty"));
  fs::create_directories(dir.file("there"));
  for (const char* output : {"frames", "new/frames/", "there"}) {
    CAPTURE(output);
    const ToolRun run = style("keyframes " + dir.file("empty") + " -o " + dir.file(output));
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("holds no pictures"));
  }
  CHECK_FALSE(fs::exists(dir.file("frames")));
  CHECK_FALSE(fs::exists(dir.file("new")));
  CHECK(fs::exists(dir.file("there")));
}
