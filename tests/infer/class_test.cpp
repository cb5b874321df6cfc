// A folder of drawings in one run: what is read, and what is said of many at once.
#include <sys/stat.h>

#include <filesystem>

#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/image/named_drawings.h"
#include "libskel/image/write_image.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

std::string figure(int size = 300) {
  CapsuleFigure capsules;
  capsules.size = size;
  return encodePng(capsuleImage(capsules));
}

// The names of the drawings in the order in which they are reported.
std::string reported(const std::string& out) {
  std::string names;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) names += line.substr(0, line.find(": ")) + " ";
  return names;
}

long count(const std::string& text, const std::string& what) {
  long found = 0;
  for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("a folder stands for its drawings in natural order, and what is no drawing is passed over") {
  const TempDir dir;
  for (const char* name : {"kid10.png", "kid9.png", "Kid 1.PNG"})
    writeFile(dir.file(std::string("class/") + name), figure());
  for (const char* name : {"kid9.mask.png", "kid9.back.png", "kid9.limbs.png", "kid9.silhouette.png",
                           "kid9.overlay.png", "kid9.layers.png", ".hidden.png"})
    writeFile(dir.file(std::string("class/") + name), figure());
  writeFile(dir.file("class/letter.txt"), "dear parents");
  writeFile(dir.file("class/deeper/other.png"), figure());
  const ToolRun run = infer(dir, "class/ -o class --formats glb --clips none --force");
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
  CHECK(reported(run.out) == "class/Kid 1.PNG class/kid9.png class/kid10.png ");
  CHECK_THAT(run.err, Contains("3 drawings: "));
  CHECK_THAT(run.err, Contains("skel-infer: note: 1 folder in there with drawings, not looked into; name it, "
                               "too: class/deeper\n"));
  CHECK(count(run.err, "not looked into") == 1);
  SECTION("a folder without drawings and results in a folder are not worth a word") {
    fs::remove(dir.file("class/deeper/other.png"));
    writeFile(dir.file("class/deeper/letter.txt"), "dear parents");
    const std::string formats = " --formats char_cfg,json --clips none --force -o class";
    infer(dir, "class" + formats);
    CHECK(count(infer(dir, "class" + formats).err, "not looked into") == 0);
    writeFile(dir.file("class/deeper/other.png"), figure());
    CHECK(infer(dir, "class --quiet --force --formats json").err ==
          "skel-infer: note: 1 folder in there with drawings, not looked into; name it, too: class/deeper\n");
  }
  SECTION("results of the first run are passed over by the second, a texture of an .obj, too") {
    fs::rename(dir.file("class/kid10.png"), dir.file("kid10.png"));
    REQUIRE(infer(dir, "kid10.png -o class --formats obj,json,overlay,silhouette").exit_code == 0);
    CHECK(reported(infer(dir, "class --formats json --force").out) == "class/Kid 1.PNG class/kid9.png ");
  }
  SECTION("folders and files are mixed") {
    writeFile(dir.file("second/anna.png"), figure());
    writeFile(dir.file("zoe.png"), figure());
    CHECK(reported(infer(dir, "zoe.png second class --formats json --force").out) ==
          "zoe.png second/anna.png class/Kid 1.PNG class/kid9.png class/kid10.png ");
  }
}

TEST_CASE("a photo that lay in a class under two names was rigged twice without a word") {
  const TempDir dir;
  for (const char* name : {"Ben.png", "Finn.png"})
    writeFile(dir.file(std::string("class/") + name), figure());
  writeFile(dir.file("class/Mia.png"), encodePng(capsuleImage({.size = 200})));
  CHECK_THAT(infer(dir, "class --formats json").err,
             Contains("note: the very same picture twice: class/Finn.png (as class/Ben.png)\n"));
  CHECK_THAT(infer(dir, "class --formats json --resume").err,
             Contains("note: the very same picture twice: class/Finn.png (as class/Ben.png)\n"));
}

TEST_CASE("films in a folder of drawings were rigged as drawings") {
  const TempDir dir;
  using namespace std::string_literals;
  const std::string start = "GIF89a\1\0\1\0\x80\0\0\0\0\0\xFF\xFF\xFF"s,
                    for_ever = "!\xFF\x0BNETSCAPE2.0\3\1\0\0\0"s, frame = ",\0\0\0\0\1\0\1\0\0\2\2\x44\1\0"s;
  writeFile(dir.file("class/kid.png"), figure());
  writeFile(dir.file("class/still.gif"), start + for_ever + frame + ";");
  writeFile(dir.file("class/walk.gif"), start + for_ever + frame + frame + ";");
  const ToolRun run = infer(dir, "class --formats json");
  CHECK(reported(run.out) == "class/kid.png ");
  CHECK_THAT(run.err, Contains("class/still.gif: ") && Contains("2 drawings: "));
  CHECK_THAT(run.err,
             Contains("note: films, no drawings, passed over (one that is named is taken by its first "
                      "frame): class/walk.gif\n"));
  CHECK_THAT(infer(dir, "class/walk.gif").err, Contains("skel-infer: class/walk.gif: "));
  fs::remove(dir.file("class/kid.png"));
  fs::remove(dir.file("class/still.gif"));
  CHECK_THAT(infer(dir, "class").err,
             Contains("class: holds no drawing") && Contains(", and films are none"));
}

TEST_CASE("results are told from drawings among 200,000 names in time") {
  std::vector<std::string> names;
  for (int i = 0; i < 100'000; ++i) {
    names.push_back("nowhere/a" + std::to_string(i) + ".png");
    names.push_back("nowhere/" + std::string(i % 2 ? "a" : "b") + std::to_string(i) + ".overlay.png");
  }
  const NamedDrawings found = drawingsOf(names);
  CHECK(found.drawings.size() == 150'000);
  CHECK(found.results.size() == 50'000);
}

TEST_CASE("a folder without a drawing is refused by name") {
  const TempDir dir;
  writeFile(dir.file("empty/letter.txt"), "dear parents");
  const ToolRun run = infer(dir, "empty");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("empty: holds no drawing (.png, .jpg"));
  CHECK_FALSE(fs::exists(dir.file("out")));
}

TEST_CASE("a folder whose name was mistyped is refused before anything is made, and the class's page stays") {
  const TempDir dir;
  writeFile(dir.file("class2/report.html"), "the page of the class");
  const ToolRun run = infer(dir, "clas2/ -o class2 --report class2/report.html");
  CHECK(run.exit_code == 2);
  CHECK(run.err == "skel-infer: clas2/: cannot be read: No such file or directory\n");
  CHECK(readFile(dir.file("class2/report.html")) == "the page of the class");
  SECTION("also where the typo is everywhere") {
    const ToolRun everywhere = infer(dir, "clas/ -o clas --report clas/report.html");
    CHECK(everywhere.exit_code == 2);
    CHECK_THAT(everywhere.err, Contains("clas/: cannot be read: No such file or directory"));
    CHECK_FALSE(fs::exists(dir.file("clas")));
  }
  SECTION("also beside drawings that are there") {
    fs::copy(kDrawing, dir.file("a.png"));
    const ToolRun beside = infer(dir, "a.png typo.png --formats json");
    CHECK(beside.exit_code == 2);
    CHECK(beside.err ==
          "skel-infer: typo.png: cannot be read: No such file or directory; nothing was rigged\n");
    CHECK_FALSE(fs::exists(dir.file("out")));
  }
}

TEST_CASE("a page is not replaced by one of drawings of which none could be opened") {
  const TempDir dir;
  writeFile(dir.file("class/a.png"), "no picture");
  writeFile(dir.file("class/b.png"), "no picture");
  writeFile(dir.file("class/report.html"), "the page of the class");
  const ToolRun run = infer(dir, "class -o class --report class/report.html");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("no drawing could be opened, so class/report.html is not written\n"));
  CHECK(readFile(dir.file("class/report.html")) == "the page of the class");
}

TEST_CASE("what is said of many drawings is said once, with the names that it holds for") {
  const TempDir dir;
  CapsuleFigure capsules;
  const Image whole = capsuleImage(capsules);
  // Without its lower third, twice.
  Image cut(whole.width, whole.height * 2 / 3);
  cut.rgba = whole.rgba.topRows(cut.rgba.rows());
  writeFile(dir.file("class/Ada.png"), encodePng(whole));
  writeFile(dir.file("class/David.png"), encodePng(cut));
  writeFile(dir.file("class/Eva B.png"), encodePng(cut));
  writeFile(dir.file("class/text.png"), "no picture");
  const ToolRun run = infer(dir, "class --formats json");
  CAPTURE(run.err);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("4 drawings: ") && Contains("2 to retake, 1 without a result\n"));
  CHECK_THAT(run.err,
             Contains("retake class/David.png 'class/Eva B.png': the figure is cut by the border of the "
                      "picture (bottom)\n"));
  CHECK(count(run.err, "cut by the border") == 1);
  CHECK(count(run.err, "class/text.png: is not a picture") == 1);
  SECTION("the list of whom to ask stood before the drawings' lines where both go into one file") {
    const std::string notes = infer(dir, "class --formats json 2>&1").out;
    CHECK(notes.find("4 drawings: ") != std::string::npos);
    CHECK(notes.find("4 drawings: ") > notes.find("Eva B.png: "));
    CHECK(notes.find("4 drawings: ") > notes.find("Ada.png: "));
  }
  SECTION("--quiet says what went wrong, nothing else") {
    const ToolRun quiet = infer(dir, "class --formats json --quiet");
    CHECK(quiet.out.empty());
    CHECK(count(quiet.err, "\n") == 1);
    CHECK_THAT(quiet.err, Contains("class/text.png: is not a picture"));
    CHECK(quiet.exit_code == 2);
  }
}

TEST_CASE("a PDF in a folder is passed over, and one line says what to convert it with") {
  const TempDir dir;
  fs::create_directories(dir.file("class"));
  writeFile(dir.file("class/Scan 1.pdf"), "%PDF");
  const ToolRun alone = infer(dir, "class");
  CHECK(alone.exit_code == 2);
  const std::string how =
      "is a PDF file; convert its pages by `pdftoppm -r 150 -png 'class/Scan 1.pdf' 'class/Scan 1'` "
      "(Debian's package "
      "poppler-utils)";
  CHECK_THAT(alone.err, Contains("class/Scan 1.pdf: " + how));
  fs::copy(kDrawing, dir.file("class/boy.png"));
  const ToolRun run = infer(dir, "class --formats silhouette");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("note: class/Scan 1.pdf " + how + "; passed over\n"));
  CHECK(infer(dir, "class --formats silhouette --quiet").err.empty());
}

TEST_CASE(
    "a photo that was converted as its note says is rigged, the one that it was made of is passed over") {
  const TempDir dir;
  writeFile(dir.file("class/IMG_1.HEIC"), "no picture");
  writeFile(dir.file("class/IMG_2.heic"), "no picture");
  fs::copy(kDrawing, dir.file("class/IMG_1.png"));
  const ToolRun run = infer(dir, "class --formats silhouette");
  CHECK(reported(run.out) == "class/IMG_1.png ");
  CHECK_THAT(run.err, Contains("class/IMG_2.heic: is a HEIC picture; convert it by `heif-convert "
                               "class/IMG_2.heic class/IMG_2.png` (Debian's package libheif-examples)"));
  CHECK(count(run.err, "IMG_1.HEIC") == 0);
}

TEST_CASE("a run over a folder that is interrupted says how to go on") {
  const TempDir dir;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    fs::create_directories(dir.file("class"));
    fs::copy(kDrawing, dir.file(std::string("class/") + name + ".png"));
  }
  const auto interrupted = [&](const std::string& out, const std::string& options) {
    return skel::runTool("cd '" + dir.path() + "'; env --default-signal=INT skel-infer class -o " + out +
                         options + " & while [ ! -e " + out +
                         "/a.glb ]; do sleep .02; done; kill -INT $!; wait $!")
        .err;
  };
  CHECK_THAT(
      interrupted("out", ""),
      Contains("skel-infer: interrupted; what is done lies in out. The same line does all "
               "again; only a run that began with --resume (and without --report) goes on where it was "
               "stopped\n"));
  CHECK_THAT(interrupted("other", " --resume"),
             Contains("skel-infer: interrupted; the same line goes on from here\n"));
}

TEST_CASE("option --report beside --resume or --from is refused with what to do") {
  const TempDir dir;
  fs::copy(kDrawing, dir.file("a.png"));
  const ToolRun resumed = infer(dir, "a.png --report r.html --resume");
  CHECK(resumed.exit_code == 1);
  CHECK_THAT(resumed.err, Contains("leave out --resume to rig all for the page, or --report to go on"));
  writeFile(dir.file("list"), "a.png\n");
  CHECK_THAT(infer(dir, "--from list --report r.html").err,
             Contains("name the drawings, or their folder, instead of --from"));
}

TEST_CASE("a path in a note can be pasted into a shell") {
  const TempDir dir;
  fs::copy(SKEL_DATASETS "/characters/water_raincoat.png", dir.file("Eva's photo.png"));
  CHECK_THAT(infer(dir, "\"Eva's photo.png\"").err, Contains("(skel-label 'Eva'\\''s photo.png', key G)"));
}

TEST_CASE("a command in a note can be pasted where the tools are not on the PATH") {
  const TempDir dir;
  for (const char* name : {"a b.png", "c.png"})
    fs::copy(SKEL_DATASETS "/characters/water_raincoat.png", dir.file(name));
  const std::string bin = binFolder(), drawing = shellWord(dir.file("a b.png"));
  const auto says = [&](const std::string& folder, const std::string& tools, const std::string& drawings) {
    return runTool("cd '" + folder + "' && PATH=/usr/bin:/bin && " + tools + "/skel-infer " + drawings +
                   " -o '" + dir.file("out") + "'")
        .err;
  };
  CHECK_THAT(says(dir.path(), bin, "'a b.png'"), Contains("(" + bin + "/skel-label 'a b.png', key G)"));
  CHECK_THAT(says(bin, ".", drawing), Contains("(./skel-label " + drawing + ", key G)"));
  const fs::path above = fs::path(bin).parent_path(), below = fs::path(bin).filename();
  CHECK_THAT(says(above, below, drawing),
             Contains("(" + below.string() + "/skel-label " + drawing + ", key G)"));
  CHECK_THAT(says(dir.path(), bin, "'a b.png' c.png"),
             Contains("(" + bin + "/skel-label FILE, key G): 'a b.png'"));
}

TEST_CASE("a folder that is named was said to be not looked into") {
  const TempDir dir;
  for (const char* name : {"k/anna.png", "k/di/ben.png", "k/mi/carl.png"})
    writeFile(dir.file(name), figure());
  const NamedDrawings found = drawingsOf({dir.file("k/"), dir.file("k/../k/di")});
  CHECK(found.folders == std::vector<std::string>{dir.file("k/mi")});
}

TEST_CASE("drawings of equal names in two folders were named one pair a run") {
  const TempDir dir;
  const auto refusal = [&] { return infer(dir, "3a 3b -o both").err; };
  const auto add = [&](const std::string& name) {
    for (const char* folder : {"3a/", "3b/"}) writeFile(dir.file(folder + name + ".png"), figure());
  };
  add("anna");
  CHECK(refusal() ==
        "skel-infer: 3a/anna.png and 3b/anna.png would both write both/anna.*; rename one or run them with "
        "different -o\n");
  for (const char* name : {"ben", "carl", "dora", "emil", "fritz"}) add(name);
  CHECK_THAT(refusal(),
             Contains("both/anna.*, as would 3a/ben.png and 3b/ben.png, 3a/carl.png and 3b/carl.png, "));
  CHECK_THAT(refusal(), Contains("3b/emil.png and 1 more; rename one"));
}
