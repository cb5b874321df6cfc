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
