// Calls that make no sense as they stand: what a tool would leave out without a word, it refuses.
#include "tests/tools/tools.h"

using namespace skel;
namespace fs = std::filesystem;

TEST_CASE("what stands before a command that has no use for it is refused, and so are two commands") {
  const TempDir dir;
  writeFigure(dir.file("set/cat.png"));
  refused(dir, "skel-infer set/cat.png evaluate set", 1, "evaluate takes no IMAGE before it");
  refused(dir, "skel-infer --formats obj evaluate set", 1,
          "evaluate takes no --formats before it; see skel-infer evaluate --help");
  refused(dir, "skel-train -o w.json evaluate set", 1, "evaluate takes no --output before it");
  refused(dir, "skel-train set figures -o f.png", 1, "figures takes no dir before it");
  refused(dir, "skel-train figures -o f.png evaluate set", 1, "figures and evaluate are two commands");
  refused(dir, "skel-label other stats set", 1, "stats takes no path before it");
  CHECK(filesBelow(dir.path()).size() == 1);
  done(dir, "skel-label --recognizer paper candidates set");
  CHECK(fs::exists(dir.file("set/cat.labels.json")));
}

TEST_CASE("a folder that holds nothing of what a command reads is refused in one line that names it") {
  const TempDir dir;
  fs::create_directory(dir.file("empty"));
  writeFile(dir.file("notes/notes.txt"), "of something else");
  writeFigure(dir.file("cat.png"));
  const std::string steps = " --steps 1 --batch 4 --validation 1 -o n.bin --drawings ";
  for (const std::string folder : {"empty", "notes"}) {
    for (const std::string& command :
         {"skel-infer " + folder,
          "skel-infer evaluate " + folder,
          "skel-label candidates " + folder,
          "skel-label import " + folder,
          "skel-label check " + folder,
          "skel-label stats " + folder,
          "skel-label motion " + folder,
          "skel-label export --coco " + folder,
          "skel-label export --csv " + folder,
          "skel-style keyframes " + folder,
          "skel-style keypoints " + folder,
          "skel-style database list " + folder,
          "skel-style database check " + folder,
          "skel-style fit " + folder,
          "skel-style transfer --content " + folder + " --style " + folder,
          "skel-style make -o x.gif --character cat.png --style a --content " + folder,
          "skel-animate list --clips-dir " + folder,
          "skel-animate info " + folder,
          "skel-animate bind -o x.glb " + folder,
          "skel-train -o w.json " + folder,
          "skel-train evaluate " + folder,
          "skel-train figures -o f.png --drawings " + folder,
          "skel-train joints" + steps + folder,
          "skel-train pages" + steps + folder,
          "skel-train parts --steps 1 -o n.bin --shapes " + folder + " --drawings " + folder,
          "skel-train bones " SKEL_SOURCE_DIR "/weights/joint_net.bin -o n.bin --drawings " + folder,
          "skel-train confidence -o c.json --biped " + folder,
          "skel-train silhouettes -o c.json " + folder,
          "skel-train loops -o c.json " + folder})
      refused(dir, command, 2, folder + ": ");
  }
  CHECK(filesBelow(dir.path()).size() == 2);
}

TEST_CASE("an output without a name is blamed, not the input") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  refused(dir, "skel-animate render cat.png --clip wave -o ''", 1, "what is to be written has no name");
  refused(dir, "skel-train figures -o ''", 1, "what is to be written has no name");
  refused(dir, "skel-infer cat.png --report page/", 4, "page/: is a folder; name a file by --report");
  CHECK_FALSE(fs::exists(dir.file("out/cat.glb")));
}

TEST_CASE("what films alone have is refused beside --sheet") {
  const TempDir dir;
  writeFigure(dir.file("cat.png"));
  for (const std::string option :
       {"--background white", "--duration 2", "--format gif", "--blend dual", "--wireframe", "--translucent",
        "--show-skeleton", "--show-weights head", "--no-shadow"}) {
    const std::string name = option.substr(0, option.find(' '));
    refused(dir, "skel-animate render cat.png --clip wave --sheet s.png " + option, 1,
            "--sheet excludes " + name);
  }
  CHECK(filesBelow(dir.path()).size() == 1);
}

TEST_CASE("truth about no drawing at all is not made without a word") {
  const TempDir dir;
  refused(dir, "skel-train parts --truth t", 1, "--truth: no drawing of --held-out has shapes in --shapes");
}

TEST_CASE("a net that could not be written is not trained first") {
  const TempDir dir;
  fs::create_directory(dir.file("folder"));
  for (const char* net : {"joints", "pages"}) {
    refused(dir, "skel-train " + std::string(net) + " --steps 1000000 --batch 4 --validation 1 -o folder", 4,
            "folder: cannot be replaced: it is a folder");
    refused(dir,
            "skel-train " + std::string(net) + " --steps 1000000 --batch 4 --validation 1 -o /proc/none/n", 4,
            "/proc/none: cannot be made");
  }
}

TEST_CASE("a batch larger than a round, or no kind to train on, divides by nothing no more") {
  const TempDir dir;
  refused(dir, "skel-train joints -o n.bin --figures 64 --passes 1 --batch 65", 1,
          "--batch 65: a round has only 64 figures (--figures times --passes)");
  std::string all;
  for (int kind = 0; kind < 100; ++kind) {
    all += " --hold-back " + std::to_string(kind);
    const ToolRun run = runIn(dir, "skel-train joints -o n.bin --figures 64 --batch 65 --passes 1" + all);
    CHECK(run.exit_code == 1);
    if (run.err.find("--hold-back leaves no body kind to train on") != std::string::npos) return;
  }
  FAIL("no number of kinds was all of them");
}
