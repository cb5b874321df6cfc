// What a tool reads it does not write over: refused before any work, under any name of the file.
#include "tests/tools/tools.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

void keeps(const TempDir& dir, const std::string& input, const std::string& command) {
  const std::string before = readFile(dir.file(input));
  refused(dir, command, 1, "would be written over, but it is an input");
  CHECK(readFile(dir.file(input)) == before);
}

// film/frame-0001.png ... of skel's own.
void writeFilm(const TempDir& dir) {
  done(dir, "skel-animate render cat.png --clip walk --fps 8 --duration 0.6 --size 96x120 -o film/");
}

}  // namespace

TEST_CASE("the pictures, templates and masks that skel-infer is given are kept") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  keeps(dir, "cat.png", "skel-infer cat.png -o . --formats obj");  // its texture
  fs::create_directories(dir.file("out"));
  fs::copy_file(dir.file("cat.png"), dir.file("out/cat.overlay.png"));
  keeps(dir, "out/cat.overlay.png", "skel-infer cat.png --back out/cat.overlay.png");
  fs::copy_file(SKEL_SOURCE_DIR "/libskel/skeleton/templates/biped.json", dir.file("out/cat.skeleton.json"));
  keeps(dir, "out/cat.skeleton.json", "skel-infer cat.png --template out/cat.skeleton.json");
  fs::copy_file(SKEL_SOURCE_DIR "/weights/default.json", dir.file("out/cat.weights.json"));
  keeps(dir, "out/cat.weights.json", "skel-infer cat.png --weights out/cat.weights.json --formats weights");
  done(dir, "skel-infer cat.png -o masks --formats silhouette");
  keeps(dir, "masks/cat.silhouette.png", "skel-infer cat.png --mask masks/cat.silhouette.png -o masks");
  fs::create_directories(dir.file("batch"));
  writeFigure(dir.file("batch/a.png"));
  writeFigure(dir.file("batch/a-2.png"));
  keeps(dir, "batch/a-2.png", "skel-infer batch/a.png batch/a-2.png -o batch --figure all --formats obj");
}

TEST_CASE("the mask that a skeleton names is kept") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer cat.png -o masks --formats silhouette");
  done(dir, "skel-infer cat.png --mask masks/cat.silhouette.png -o a --formats json");
  keeps(dir, "masks/cat.silhouette.png", "skel-infer cat.png --skeleton a/cat.skeleton.json -o masks");
  CHECK_FALSE(fs::exists(dir.file("masks/cat.glb")));
  // The skeleton itself is gone on from.
  done(dir, "skel-infer cat.png --skeleton a/cat.skeleton.json -o a");
}

TEST_CASE("results of the last time among the pictures are written anew") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer *.png -o .");
  done(dir, "skel-infer *.png -o .");
  CHECK(fs::exists(dir.file("cat.overlay.png")));
}

TEST_CASE("the model, the skeleton and the textures that skel-animate binds are kept") {
  const TempDir dir;
  const std::string elk = SKEL_SOURCE_DIR "/datasets/elk/";
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer cat.png -o . --formats glb --clips none && mv cat.glb x.glb");
  keeps(dir, "x.glb", "skel-animate bind x.glb -o x.glb");
  fs::create_symlink("x.glb", dir.file("link.glb"));
  fs::create_hard_link(dir.file("x.glb"), dir.file("twin.glb"));
  keeps(dir, "x.glb", "skel-animate bind x.glb -o ./link.glb");
  keeps(dir, "x.glb", "skel-animate bind x.glb -o twin.glb");
  keeps(dir, "x.glb", "skel-animate weights x.glb -o x.glb");
  keeps(dir, "x.glb", "skel-animate retarget wave --to x.glb -o x.glb");
  keeps(dir, "x.glb", "skel-animate render x.glb --clip wave -o x.glb");
  fs::copy_file(elk + "elk.rig.json", dir.file("rig.json"));
  keeps(dir, "rig.json", "skel-animate weights " + elk + "elk.obj --skeleton rig.json -o rig.json");
  done(dir, "skel-infer cat.png -o obj --formats obj");
  for (const std::string named : {"cat.obj", "cat.mtl", "cat.png"}) {
    fs::create_hard_link(dir.file("obj/" + named), dir.file(named + ".glb"));
    keeps(dir, "obj/" + named, "skel-animate bind obj/cat.obj --skeleton rig.json -o " + named + ".glb");
  }
}

TEST_CASE("films, frames and motions that skel-style is given are kept") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  writeFilm(dir);
  done(dir, "skel-style keypoints film -o a.motion.json --action walk");
  const std::string make = "skel-style make --character cat.png --content ";
  keeps(dir, "a.motion.json", make + "a.motion.json --style film -o a.motion.json");
  keeps(dir, "cat.png", make + "a.motion.json --style film -o cat.png");
  keeps(dir, "film/frame-0001.png", make + "film --style a.motion.json -o film/ --work w");
  fs::create_directories(dir.file("w"));
  fs::copy_file(dir.file("a.motion.json"), dir.file("w/transfer.motion.json"));
  keeps(dir, "w/transfer.motion.json",
        make + "w/transfer.motion.json --style a.motion.json -o b.gif --work w");
  keeps(dir, "a.motion.json",
        "skel-style transfer --content a.motion.json --style a.motion.json -o a.motion.json");
  keeps(dir, "film/frame-0002.png", "skel-style keypoints film -o film/frame-0002.png --force");
  keeps(dir, "a.motion.json", "skel-style inspect a.motion.json -o a.motion.json");
  refused(dir, "skel-style render --motion a.motion.json --character cat.png -o x.gif --to-clip ./x.gif", 1,
          "is to be written twice");
}

TEST_CASE("a folder of frames that holds other pictures of such names is refused") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  writeFigure(dir.file("film/frame-0001.png"));
  const std::string before = readFile(dir.file("film/frame-0001.png"));
  const std::string render =
      "skel-animate render cat.png --clip walk --fps 8 --duration 0.3 --size 64x80 -o ";
  refused(dir, render + "film/", 4, "film/frame-0001.png: is not one of skel's pictures; move it away");
  CHECK(readFile(dir.file("film/frame-0001.png")) == before);
  done(dir, render + "own/");
  done(dir, render + "own/");  // its own it replaces
}

TEST_CASE("weights and pictures that skel-train and skel-label are given are kept") {
  const TempDir dir;
  fs::create_directories(dir.file("set"));
  for (const char* name : {"cap_boy.png", "cap_boy.labels.json", "cap_boy.mask.png"})
    if (const std::string from = std::string(SKEL_SOURCE_DIR "/datasets/characters/") + name;
        fs::exists(from))
      fs::copy_file(from, dir.file(std::string("set/") + name));
  fs::copy_file(SKEL_SOURCE_DIR "/weights/default.json", dir.file("w.json"));
  keeps(dir, "w.json", "skel-train evaluate set --weights w.json --json w.json");
  keeps(dir, "set/cap_boy.png", "skel-label motion set -o set/cap_boy.png --force");
  keeps(dir, "set/cap_boy.png", "skel-label export set --csv -o set/cap_boy.png");
  const std::string labels = readFile(dir.file("set/cap_boy.labels.json"));
  for (const char* command :
       {"skel-train evaluate set --weights w.json --json ", "skel-label export set --csv -o "})
    refused(dir, command + std::string("set/cap_boy.labels.json"), 4,
            "set/cap_boy.labels.json: is a file of format \"skel-labels\"");
  CHECK(readFile(dir.file("set/cap_boy.labels.json")) == labels);
}

TEST_CASE("skeletons beside the drawings of a set were written over by what was made of the set") {
  const TempDir dir;
  copyLabelledBoy(dir, "C");
  writeFile(dir.file("C/cap_boy.skeleton.json"), "mended by hand");
  for (const char* command :
       {"skel-infer evaluate C --json ", "skel-train C --folds 0 -o ", "skel-train C -o w.json --json ",
        "skel-train evaluate C --json ", "skel-label export C --coco -o ", "skel-label export C --csv -o "})
    keeps(dir, "C/cap_boy.skeleton.json", command + std::string("C/cap_boy.skeleton.json"));
}

TEST_CASE("joints annotated beside the drawings of a set were written over by what was made of the set") {
  const TempDir dir;
  copyLabelledBoy(dir, "C");
  writeFile(dir.file("C/cap_boy.joints.json"), R"({"joints": {"head": [300, 100]}})");
  // Whose picture has gone.
  writeFile(dir.file("C/alien.joints.json"), R"({"joints": {"head": [300, 100]}})");
  for (const char* command :
       {"skel-train C --folds 0 -o ", "skel-train C -o w.json --json ", "skel-train evaluate C --json ",
        "skel-train evaluate C --candidates discs --json ", "skel-train joints --drawings C --steps 1 -o "})
    for (const char* joints : {"C/cap_boy.joints.json", "C/alien.joints.json"})
      keeps(dir, joints, command + std::string(joints));
}

TEST_CASE("a file of skel's own is not replaced by one of another kind") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer cat.png -o . --formats json");
  const std::string skeleton = readFile(dir.file("cat.skeleton.json")),
                    there =
                        "cat.skeleton.json: is a file of format \"skel-skeleton\", and would be replaced by ";
  refused(dir, "skel-animate weights cat.png -o cat.skeleton.json", 4,
          there + "a file of format \"skel-skin\"; name another output");
  refused(dir, "skel-label export . --csv -o cat.skeleton.json", 4,
          there + "something else; name another output");
  refused(dir, "skel-infer evaluate . --json cat.skeleton.json", 4,
          there + "something else; name another output");
  CHECK(readFile(dir.file("cat.skeleton.json")) == skeleton);
}
