// Pipes, devices, links, modes, signals.
#include <filesystem>

#include <sys/stat.h>

#include <csignal>

#include "tests/tools/tools.h"

using namespace skel;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a drawing comes through /dev/stdin") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  done(dir, "skel-infer cat.png && cat cat.png | skel-infer /dev/stdin");
  CHECK(readFile(dir.file("out/stdin.overlay.png")) == readFile(dir.file("out/cat.overlay.png")));
  done(dir, "cat out/cat.silhouette.png | skel-infer cat.png --mask /dev/stdin -o masked");
  refused(dir, "cat cat.png | skel-style keyframes /dev/stdin", 2,
          "/dev/stdin: is a pipe or a device; films are read from files");
}

TEST_CASE("a pipe that lies in a folder, or that a file names, is not waited for") {
  const TempDir dir;
  const auto pipe = [&](const std::string& name) {
    fs::create_directories(fs::path(dir.file(name)).parent_path());
    REQUIRE(mkfifo(dir.file(name).c_str(), 0600) == 0);
  };
  const auto notWaited = [&](const std::string& command, const std::string& message) {
    refused(dir, "timeout 60 " + command, 2, message);
  };
  const std::string is_pipe = "is a pipe, not a file; pipes are read where the command line names them";
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  pipe("drawings/a.png");
  notWaited("skel-infer drawings", "drawings: holds no drawing");
  pipe("mtl/a.mtl");
  writeFile(dir.file("mtl/a.obj"), "mtllib a.mtl\n" + triangle);
  notWaited("skel-animate info mtl/a.obj", "mtl/a.mtl: " + is_pipe);
  pipe("picture/a.png");
  writeFile(dir.file("picture/a.mtl"), "newmtl m\nmap_Kd a.png\n");
  writeFile(dir.file("picture/a.obj"), "mtllib a.mtl\nusemtl m\n" + triangle);
  notWaited("skel-animate info picture/a.obj", "picture/a.png: " + is_pipe);
  pipe("database/index.json");
  notWaited("skel-style database list database", "database/index.json: " + is_pipe);
  writeFigure(dir.file("cat.png"));
  writeFigure(dir.file("film/1.png"));
  done(dir, "skel-infer cat.png -o rigged && skel-style keypoints film -o m.motion.json");
  done(dir, "rm cat.png && mkfifo cat.png");
  notWaited("skel-style render --character rigged/cat.skeleton.json --motion m.motion.json -o cat.gif",
            "cat.png: " + is_pipe);
}

TEST_CASE("what is printed and does not arrive is an output error") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  for (const char* command :
       {"skel-infer cat.png", "skel-infer --help", "skel-infer --version", "skel-animate list",
        "skel-train --help", "skel-label --help", "skel-style make --help"})
    refused(dir, std::string(command) + " > /dev/full", 4,
            "standard output: cannot be written: No space left on device");
}

TEST_CASE("an output that cannot be there is an output error, before any work") {
  const TempDir dir;
  std::filesystem::create_symlink("loop", dir.file("loop"));
  const std::string drawing = std::string(SKEL_SOURCE_DIR) + "/datasets/characters/cap_boy.png",
                    far(300, 'x');
  for (const std::string& output : {std::string("loop"), far})
    for (const std::string& call :
         {"skel-infer " + drawing + " -o " + output, "skel-infer " + drawing + " -o out --report " + output,
          "skel-infer evaluate --json " + output + " set",
          "skel-animate render " + drawing + " --clip walk -o " + output,
          "skel-animate render " + drawing + " --clip walk --sheet " + output,
          "skel-animate bind " + drawing + " -o " + output, "skel-style render --motion m.json -o " + output,
          "skel-style make --character " + drawing + " --content a.mp4 --style b.mp4 -o " + output,
          "skel-style keypoints a.mp4 -o " + output, "skel-label motion frames -o " + output,
          "skel-train datasets -o " + output}) {
      CAPTURE(call);
      const ToolRun run = runTool("cd '" + dir.path() + "' && " + call);
      CAPTURE(run.err);
      CHECK(run.exit_code == 4);
      CHECK_THAT(run.err, Catch::Matchers::Contains(output + ": cannot be "));
      CHECK_FALSE(std::filesystem::exists(dir.file("out")));
    }
}

TEST_CASE("devices and pipes are written into and stay what they are") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  fs::create_directories(dir.file("set"));
  for (const char* name : {"cap_boy.png", "cap_boy.labels.json", "cap_boy.mask.png"})
    if (const std::string from = std::string(SKEL_SOURCE_DIR "/datasets/characters/") + name;
        fs::exists(from))
      fs::copy_file(from, dir.file(std::string("set/") + name));
  const std::string write = "skel-label export set --csv -o ";
  done(dir, write + "/dev/null");
  refused(dir, write + "/dev/full", 4, "/dev/full: cannot be written: No space left on device");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(fs::is_character_file("/dev/full"));
  done(dir, write + "table.csv");
  const std::string table = readFile(dir.file("table.csv"));
  done(dir, "mkfifo pipe && { cat pipe > read & } && " + write + "pipe && wait");
  CHECK(readFile(dir.file("read")) == table);
  CHECK(fs::is_fifo(dir.file("pipe")));
  CHECK(done(dir, write + "/dev/stdout | cat").out == table);
  CHECK(done(dir, write + "/dev/stdout > both && cat both").out == table);
  done(dir, "ln -s there/table.csv link.csv && " + write + "link.csv");
  CHECK(fs::is_symlink(dir.file("link.csv")));
  CHECK(readFile(dir.file("there/table.csv")) == table);
  done(dir, "echo old > private.csv && chmod 600 private.csv && " + write + "private.csv");
  struct stat status;
  REQUIRE(stat(dir.file("private.csv").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
}

TEST_CASE("a result on the standard output stood among what else is said") {
  const TempDir dir;
  copyLabelledBoy(dir, "set");
  for (const char* command :
       {"skel-label export set --coco -o ", "skel-infer evaluate set --json ",
        "skel-train evaluate set --json ", "skel-train set --folds 0 --epochs 2 --generated 0 -o "}) {
    CAPTURE(command);
    std::string said = done(dir, command + std::string("result.json")).out;
    const std::string result = readFile(dir.file("result.json"));
    fs::remove(dir.file("result.json"));
    if (const size_t name = said.find("result.json"); name != std::string::npos)
      said.replace(name, 11, "/dev/stdout");
    const ToolRun piped = done(dir, command + std::string("/dev/stdout"));
    CHECK(piped.out == result);
    CHECK(piped.err.find(said) != std::string::npos);
    done(dir, command + std::string("/dev/stdout > redirected.json"));
    CHECK(readFile(dir.file("redirected.json")) == result);
  }
}

TEST_CASE("a motion for the standard output was looked for there, to keep what it holds") {
  const TempDir dir;
  writeFigure(dir.file("film/1.png"));
  const ToolRun piped = done(dir, "timeout 60 skel-label motion film -o /dev/stdout | cat");
  CHECK(piped.out.starts_with("{"));
  CHECK(piped.err.find("1 frames") != std::string::npos);
  done(dir, "skel-label motion film -o /dev/stdout > m.motion.json 2> said");
  CHECK(readFile(dir.file("m.motion.json")) == piped.out);
}

TEST_CASE("a blank mask is blamed, not the drawing") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  Image blank = blankImage(160, 200);
  blank.rgba.leftCols(3).setZero();
  writeFile(dir.file("blank.png"), encodePng(blank));
  refused(dir, "skel-infer cat.png --mask blank.png", 2, "skel-infer: blank.png: the mask is blank");
}

TEST_CASE("tools die by the signal and leave no temporary file") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  for (const char* signal : {"TERM", "HUP"}) {
    // It waits for the pipe.
    const ToolRun run =
        runIn(dir, "rm -f pipe; mkfifo pipe; skel-infer cat.png --mask pipe & tool=$!; sleep 1; kill -" +
                       std::string(signal) + " $tool; wait $tool");
    CHECK(run.exit_code == 128 + (std::string(signal) == "TERM" ? SIGTERM : SIGHUP));
  }
  done(dir,
       "for i in 1 2 3 4 5 6 7 8 9; do cp cat.png $i.png; done; for wait in 0.05 0.1 0.2 0.4; do "
       "skel-infer [1-9].png --jobs 4 2>/dev/null & tool=$!; sleep $wait; kill -TERM $tool 2>/dev/null; "
       "wait $tool; done; true");
  for (const std::string& file : filesBelow(dir.path())) CHECK_FALSE(file.ends_with(".skel-tmp"));
}
