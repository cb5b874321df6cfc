// Names out of files and odd names of files: none leads elsewhere, none makes a file that cannot be read.
#include <map>

#include "tests/tools/tools.h"

using namespace skel;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string clipFile(const std::string& name, const std::string& more = "") {
  return R"({"format": "skel-clip", "version": 1, "name": ")" + name + "\"" + more +
         R"(, "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 30]]}]})";
}

int countOf(const std::string& text, const std::string& word) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++count;
  return count;
}

}  // namespace

TEST_CASE("a clip named ../../evil is written beside the others") {
  const TempDir dir;
  writeFigure(dir.file("a/b/cat.png"));
  writeFile(dir.file("clips/x.clip.json"), clipFile("../../evil"));
  writeFile(dir.file("clips/y.clip.json"), clipFile("_._.._evil"));
  const auto before = filesBelow(dir.path());
  done(dir,
       "cd a/b && skel-infer cat.png --formats bvh --clips-dir ../../clips --clips ../../evil,_._.._evil");
  CHECK(fs::exists(dir.file("a/b/out/cat-_._.._evil.bvh")));
  CHECK(fs::exists(dir.file("a/b/out/cat-_._.._evil-2.bvh")));
  CHECK(filesBelow(dir.path()).size() == before.size() + 2);
}

TEST_CASE("listings show a clip's or a motion's name on one line, whatever it holds") {
  const TempDir dir;
  writeFile(dir.file("clips/x.clip.json"), clipFile(R"(a\nb\u0000\u001b[31m)"));
  const std::string clips = done(dir, "skel-animate list --clips-dir clips").out;
  CHECK_THAT(clips, Contains(R"(a\nb\x00\x1b[31m)"));
  CHECK(clips.find('\x1b') == clips.npos);

  writeFigure(dir.file("film/1.png"));
  done(dir, "skel-style keypoints film -o m.motion.json");
  done(dir, R"~(skel-style database add db m.motion.json --action "$(printf 'a\033[31m')")~");
  const std::string motions = done(dir, "skel-style database list db").out;
  CHECK_THAT(motions, Contains(R"(a\x1b[31m)"));
  CHECK(motions.find('\x1b') == motions.npos);
}

TEST_CASE("a file's name commands no terminal, whatever a tool says of it") {
  const TempDir dir;
  const std::string esc = "\x1b[31m";
  writeFigure(dir.file("film/1.png"));
  writeFigure(dir.file("film/2.png"), 8);
  for (const std::string name : {"elk.obj", "elk.mtl"})
    fs::copy_file(SKEL_SOURCE_DIR "/datasets/elk/" + name, dir.file(name));
  fs::copy_file(SKEL_SOURCE_DIR "/datasets/elk/elk.rig.json", dir.file(esc + ".rig.json"));
  fs::create_directory(dir.file("labelled"));
  for (const char* ending : {".png", ".mask.png", ".labels.json"})
    fs::copy_file(SKEL_SOURCE_DIR "/datasets/characters/cap_boy" + std::string(ending),
                  dir.file("labelled/cap_boy" + std::string(ending)));
  const std::string film = " --fps 4 --duration 0.5 --size 64x64 ";
  for (const std::string& command :
       {"skel-animate bind elk.obj --skeleton '" + esc + ".rig.json' -o '" + esc + ".glb'",
        "skel-animate weights elk.obj --skeleton '" + esc + ".rig.json' -o '" + esc + ".weights.json'",
        "skel-animate list '" + esc + ".glb'",
        "skel-animate retarget idle --to '" + esc + ".glb' -o 'to " + esc + ".glb'",
        "skel-animate render '" + esc + ".glb' --clip idle" + film + "-o '" + esc + ".gif'",
        "skel-label export labelled --csv -o '" + esc + ".csv'",
        "skel-style keyframes film -o '" + esc + " keys'",
        "skel-style keypoints film -o '" + esc + ".motion.json'"}) {
    CAPTURE(command);
    const ToolRun run = runIn(dir, command);
    CHECK(run.exit_code == 0);
    CHECK((run.out + run.err).find("\\x1b[31m") != std::string::npos);
    CHECK((run.out + run.err).find('\x1b') == std::string::npos);
  }
  refused(dir, "skel-animate list 'a.glb' '" + esc + "'", 1, "\\x1b[31m");
}

TEST_CASE("a motion whose file's name is not UTF-8 is put onto a model, under a name that a file can hold") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer cat.png --formats glb");
  done(dir, "skel-animate retarget walk --to out/cat.glb -o '\xff\xfe.bvh'");
  done(dir, "skel-animate retarget '\xff\xfe.bvh' --to out/cat.glb -o moved.glb");
  CHECK_THAT(done(dir, "skel-animate list moved.glb").out, Contains(R"(\xff\xfe)"));
}

TEST_CASE("a COCO file that names pictures outside of its folder is refused") {
  const TempDir dir;
  writeFigure(dir.file("outside/cat.png"));
  fs::create_directories(dir.file("set"));
  const auto coco = [](const std::string& file) {
    return R"({"images": [{"id": 1, "file_name": ")" + file + R"("}], "annotations": [{"image_id": 1, "bbox":
      [0, 0, 9, 9], "segmentation": [[40, 40, 120, 40, 120, 180, 40, 180]], "keypoints": [)" +
           [] {
             std::string points;
             for (int i = 0; i < 17; ++i) points += (i ? ", " : "") + std::string("80, 80, 2");
             return points;
           }() +
           "]}]}";
  };
  const std::vector<std::string> before = filesBelow(dir.file("outside"));
  for (const std::string& file : {std::string("../outside/cat.png"), dir.file("outside/cat.png")}) {
    writeFile(dir.file("set/coco.json"), coco(file));
    refused(dir, "skel-label import set", 2, "which lies outside of its folder; move the files together");
  }
  CHECK(filesBelow(dir.file("outside")) == before);
}

TEST_CASE(
    "drawings with #, backslash, newline or outer blanks in the name give an OBJ that is read again, or "
    "none") {
  const TempDir dir;
  for (const std::string name : {"a b", " a", "-a", "a ", "\xC3\xA4"}) {
    CAPTURE(name);
    writeFigure(dir.file(name + ".png"));
    done(dir, "skel-infer './" + name + ".png' --formats obj");
    CHECK_THAT(done(dir, "skel-animate info './out/" + name + ".obj'").out, Contains("texture: "));
    CHECK(countOf(done(dir, "skel-animate info './out/" + name + ".obj'").out, "texture: none") == 0);
  }
  for (const std::string name : {"a#b", "a\\b", "a\nb"}) {
    CAPTURE(name);
    writeFigure(dir.file(name + ".png"));
    refused(dir, "skel-infer './" + name + ".png' --formats obj -o none", 1,
            "as it is: rename the drawing, without #, \\ and line breaks");
    CHECK_FALSE(fs::exists(dir.file("none")));
    done(dir, "skel-infer './" + name + ".png' --formats glb -o glb");
  }
}

TEST_CASE("films whose names look like addresses are files, and play lists are none") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  const ToolRun made =
      runIn(dir, "skel-animate render cat.png --clip walk --fps 8 --duration 0.5 --size 96x120 -o film.mp4");
  if (made.exit_code == 3 || made.exit_code == 1) return;  // a build or a machine without MP4
  REQUIRE(made.exit_code == 0);
  for (const std::string name : {"take:1.mp4", "pipe:0.mp4", "http:x.mp4"}) {
    fs::copy_file(dir.file("film.mp4"), dir.file(name));
    CHECK_THAT(done(dir, "skel-style keyframes " + name + " -o 'keys " + name + "' </dev/null").out,
               Contains("frames are key frames"));
  }
  const std::map<std::string, std::string> lists = {
      {"list.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nfilm.mp4\n#EXT-X-ENDLIST\n"},
      {"list.ffconcat", "ffconcat version 1.0\nfile film.mp4\n"},
      {"list.sdp", "v=0\no=- 0 0 IN IP4 127.0.0.1\nc=IN IP4 127.0.0.1\nt=0 0\nm=video 5004 RTP/AVP 96\n"},
      {"list.mpd", "<?xml version=\"1.0\"?><MPD><BaseURL>film.mp4</BaseURL></MPD>\n"}};
  for (const auto& [name, text] : lists) {
    writeFile(dir.file(name), text);
    refused(dir, "skel-style keyframes " + name, 2, name + ": cannot be read as a film: ");
  }
}

TEST_CASE("an own walk without a template takes the place of the built-in one, and walk,walk is one walk") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  writeFile(dir.file("clips/walk.clip.json"), clipFile("walk"));
  done(
      dir,
      "skel-infer cat.png --formats glb --clips-dir clips && skel-infer cat.png --formats glb -o two --clips "
      "walk,wave,walk");
  const std::string info = done(dir, "skel-animate info out/cat.glb").out;
  CHECK(countOf(info, "clip: walk") == 1);
  CHECK_THAT(info, Contains("clip: walk, 9.00 s"));
  const std::string two = done(dir, "skel-animate info two/cat.glb").out;
  CHECK(countOf(two, "clip: walk") == 1);
  CHECK(countOf(two, "clip: wave") == 1);
  writeFile(dir.file("clips/again.clip.json"), clipFile("walk", R"(, "template": "biped")"));
  refused(dir, "skel-infer cat.png --clips-dir clips --clips walk", 2,
          "is the second clip \"walk\" for the template \"biped\"");
}

TEST_CASE("an annotation of torso and body is one joint, and passes the check") {
  const TempDir dir;
  writeFigure(dir.file("set/cat.png"));
  writeFile(
      dir.file("set/cat.joints.json"),
      R"({"joints": {"torso": [10, 10], "body": [80, 90], "head": [80, 40], "hip": [80, 120], "pelvis": null}})");
  done(dir, "skel-label import set");
  const std::string labels = readFile(dir.file("set/cat.labels.json"));
  const std::string joints = labels.substr(labels.find("\"joints\""));
  CHECK(countOf(joints, "\"body\"") == 1);
  CHECK(countOf(joints, "\"pelvis\"") == 1);
  done(dir, "skel-label check set");
}

TEST_CASE("a mask made by hand is not written over by an import") {
  const TempDir dir;
  const std::string coco = R"({"images": [{"id": 1, "file_name": "cat.png"}], "annotations": [{"image_id": 1,
    "segmentation": [[40, 10, 120, 10, 120, 190, 40, 190]], "category_id": 1, "keypoints": [80, 40, 2]}],
    "categories": [{"id": 1, "keypoints": ["head"]}]})";
  writeFigure(dir.file("set/cat.png"));
  writeFile(dir.file("set/coco.json"), coco);
  Image mask = blankImage(160, 200);
  mask.rgba.leftCols(3).setZero();
  drawDisc(mask, {80, 100}, 60, {255, 255, 255});
  const std::string by_hand = encodePng(mask);
  writeFile(dir.file("set/cat.mask.png"), by_hand);
  const ToolRun run = runIn(dir, "skel-label import set");
  CHECK(run.exit_code == 2);
  CHECK_THAT(
      run.err,
      Contains("set/cat.mask.png: is there already, with other content; take it away, or give --force"));
  CHECK(readFile(dir.file("set/cat.mask.png")) == by_hand);
  CHECK_FALSE(fs::exists(dir.file("set/cat.labels.json")));
  done(dir, "skel-label import set --force");
  CHECK(readFile(dir.file("set/cat.mask.png")) != by_hand);
}

TEST_CASE("eight motions added at the same time are eight entries") {
  const TempDir dir;
  writeFigure(dir.file("film/1.png"), -8);
  writeFigure(dir.file("film/2.png"), 0);
  writeFigure(dir.file("film/3.png"), 8);
  done(dir, "skel-style keypoints film -o m.motion.json --action walk");
  done(dir,
       "for i in 1 2 3 4 5 6 7 8; do cp m.motion.json $i.motion.json; done; for i in 1 2 3 4 5 6 7 8; do "
       "skel-style database add db $i.motion.json & done; wait");
  CHECK_THAT(done(dir, "skel-style database check db").out, Contains("8 motions, 0 problems"));
  done(dir, "skel-style database add db db/3.motion.json --action run --force");
  CHECK_THAT(done(dir, "skel-style database check db").out, Contains("8 motions, 0 problems"));
}
