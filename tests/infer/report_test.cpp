// --report: one page of HTML for a class.
#include <filesystem>

#include "infer/advice.h"
#include "libskel/core/files.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

size_t countIn(const std::string& text, const std::string& what) {
  size_t found = 0;
  for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
  return found;
}

// A class with a good drawing, one that is cut off, one that is no picture.
std::string reportOf(const TempDir& dir, const std::string& options = "") {
  const Image whole = capsuleImage();
  Image cut(whole.width, whole.height * 2 / 3);
  cut.rgba = whole.rgba.topRows(cut.rgba.rows());
  writeFile(dir.file("class/<b>Tom & \"Jerry\".png"), encodePng(whole));
  writeFile(dir.file("class/David.png"), encodePng(cut));
  writeFile(dir.file("class/text.png"), "no picture");
  infer(dir, "class -o class --formats json --report class/report.html " + options);
  return readFile(dir.file("class/report.html"));
}

}  // namespace

TEST_CASE("the report shows each drawing beside its moving figure, and what to take again and why") {
  const TempDir dir;
  const std::string html = reportOf(dir);
  CHECK_THAT(html, Contains("<h1><span class=\"all\">3 drawings</span>"));
  CHECK_THAT(html, Contains(", 1 to mend or take again, 1 without a figure<"));
  CHECK(countIn(html, "<article ") == 3);
  CHECK(countIn(html, "class=\"drawing\"") == 2);
  CHECK(countIn(html, "class=\"film\"") == 2);
  CHECK(countIn(html, "sure of the joints") == 2);
  CHECK_THAT(html, Contains(">David</a> The figure is cut off at the bottom. Step back"));
  CHECK_THAT(html, Contains(">text</a> is not a picture that can be read"));
  CHECK_THAT(html, Contains("@media print") && Contains("prefers-color-scheme: dark"));
}

TEST_CASE("the report says where skel-label is once, not in each sentence") {
  const TempDir dir;
  std::filesystem::copy(SKEL_DATASETS "/characters/water_raincoat.png", dir.file("a b.png"));
  const std::string bin = binFolder();
  REQUIRE(runTool("cd '" + dir.path() + "' && PATH=/usr/bin:/bin && " + bin +
                  "/skel-infer 'a b.png' --report r.html --formats json")
              .exit_code == 0);
  const std::string html = readFile(dir.file("r.html"));
  CHECK(countIn(html, bin + "/skel-label") == 1);
  CHECK_THAT(html, Contains("<p class=\"tool\">skel-label is " + bin + "/skel-label</p>") &&
                       Contains("(skel-label &#39;a b.png&#39;, key G)"));
}

TEST_CASE("the report lists on top what to look at, one line a child, and says all that the terminal says") {
  const TempDir dir;
  std::filesystem::create_directories(dir.file("class"));
  std::filesystem::copy(SKEL_DATASETS "/characters/cap_boy.png", dir.file("class/Ann.png"));
  const Image boy = readImage(SKEL_DATASETS "/characters/cap_boy.png");
  Image two(2 * boy.width, boy.height * 2 / 3);
  for (int y = 0; y < two.height; ++y)
    for (int x = 0; x < two.width; ++x)
      for (int c = 0; c < 4; ++c)  // on white paper
        two.pixel(x, y)[c] =
            c < 3 && boy.pixel(x % boy.width, y)[3] > 0 ? boy.pixel(x % boy.width, y)[c] : 255;
  writeFile(dir.file("class/Two.png"), encodePng(two));
  // A mask of another photo: something to look at.
  std::filesystem::copy(SKEL_DATASETS "/characters/clown.png", dir.file("class/Zoe.png"));
  std::filesystem::copy(SKEL_DATASETS "/characters/clown.mask.png", dir.file("class/Zoe.mask.png"));
  infer(dir, "class/Zoe.png -o class --formats json");
  std::filesystem::copy(SKEL_DATASETS "/characters/cap_boy.png", dir.file("class/Zoe.png"),
                        std::filesystem::copy_options::overwrite_existing);
  const ToolRun run = infer(dir, "class -o class --formats json --report class/report.html");
  const std::string html = readFile(dir.file("class/report.html"));
  const size_t retake = html.find("<h2>Mend these, or take the photo again</h2>"),
               look = html.find("<h2>Drawings to look at</h2>");
  REQUIRE(retake < look);
  REQUIRE(look < html.find("<main>"));
  const std::string top = html.substr(look, html.find("</section>", look) - look);
  CHECK(countIn(top, "<li>") == 1);
  CHECK_THAT(top, Contains(">Zoe</a> The mask was there before the picture changed: look at it (skel-label "
                           "class/Zoe.png)."));
  const std::string again = html.substr(retake, html.find("</section>", retake) - retake);
  CHECK(countIn(again, "<li>") == 1);
  REQUIRE(countIn(run.err, "retake class/Two.png: ") == 3);
  for (const char* reason :
       {"There are 2 figures in the picture; the largest was taken (skel-infer takes the next "
        "one with --figure 2, and each with --figure all).",
        "The figure is cut off at the ", "No whole figure could be made out"})
    CHECK_THAT(again, Contains(reason));
  CHECK_THAT(html, Contains("<p class=\"note\">made by hand and taken up"));
  // Who shows pictures alone may leave out those to look at.
  CHECK_THAT(html, Contains("<label for=\"good\">only the good ones</label>"));
  CHECK(countIn(html, "<article id=\"d") ==
        countIn(html, "class=\"doubt\">") + countIn(html, "class=\"chip fine\""));
}

TEST_CASE("a blank sheet had neither picture nor advice, and files to convert were photos to take again") {
  const TempDir dir;
  writeFile(dir.file("class/Ann.png"), encodePng(capsuleImage()));
  Image blank(300, 400);
  blank.rgba.setConstant(255);
  writeFile(dir.file("class/Blank.png"), encodePng(blank));
  writeFile(dir.file("class/Eva.heic"), "no picture");
  const ToolRun run = infer(dir, "class -o class --formats json --report class/report.html");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("3 drawings: 1 fine, 1 to retake, 1 without a result\n"
                               "retake class/Blank.png: nothing was found on it\n"));
  const std::string html = readFile(dir.file("class/report.html"));
  const auto partFrom = [&](const std::string& start, const char* end) {
    const size_t at = html.find(start);
    REQUIRE(at != html.npos);
    return html.substr(at, html.find(end, at) - at);
  };
  const std::string again = partFrom("<h2>Mend these, or take the photo again</h2>", "</section>");
  CHECK(countIn(again, "<li>") == 1);
  CHECK_THAT(again, Contains(">Blank</a> Nothing was found on it. "));
  const std::string not_used = partFrom("<h2>Files without a figure</h2>", "</section>");
  CHECK(countIn(not_used, "<li>") == 1);
  CHECK_THAT(not_used, Contains(">Eva</a> is a HEIC picture; convert it by <code>heif-convert class/Eva.heic "
                                "class/Eva.png</code> (Debian"));
  const std::string card = partFrom("<h2>Blank</h2>", "</article>");
  CHECK_THAT(card, Contains(">mend or retake</span>") && Contains("class=\"drawing\"") &&
                       Contains("Nothing was found on it. "));
  // Beside the pictures alone, those that are shown are counted.
  CHECK_THAT(html,
             Contains("<h1><span class=\"all\">3 drawings</span><span class=\"shown\">1 drawing</span>"));
}

TEST_CASE("what was mended of an earlier photo and is left out was not said on top of the report") {
  const TempDir dir;
  std::filesystem::create_directories(dir.file("class"));
  const std::string photo = dir.file("class/Jörg.png"), skeleton = dir.file("class/Jörg.skeleton.json");
  std::filesystem::copy(SKEL_DATASETS "/characters/cap_boy.png", photo);
  infer(dir, "class -o class --formats json");
  std::string text = readFile(skeleton);
  const std::string found = "\"recognized\"";
  writeFile(skeleton, text.replace(text.find(found), found.size(), "\"edited\""));
  const auto report = [&] {
    CHECK(infer(dir, "class -o class --formats json --report class/report.html").exit_code == 0);
    return readFile(dir.file("class/report.html"));
  };
  constexpr const char* kTitle = "<h2>What was mended of an earlier photo, and is left out</h2>";
  CHECK_THAT(report(), !Contains(kTitle));
  std::filesystem::copy(SKEL_DATASETS "/characters/clown.png", photo,
                        std::filesystem::copy_options::overwrite_existing);
  CHECK_THAT(report(), Contains(kTitle) &&
                           Contains(">Jörg</a> What you had mended of an earlier photo is left out. ") &&
                           Contains(">Jörg</a> Jörg.skeleton.json (now Jörg.skeleton.old.json; --skeleton "
                                    "class/Jörg.skeleton.old.json takes it up)</li>"));
}

TEST_CASE("advice fits the picture: of light and pen it speaks for photos alone, and it names the command") {
  RiggedDrawing drawing;
  SkeletonFile file;
  const auto advice = [&](const char* warning) {
    file.warnings = {warning};
    return adviceOn(drawing, file, "class/Eva B.png", true).front();
  };
  const char* const warnings[] = {"this hardly looks like one whole biped",
                                  "some joints may be wrong, look at them",
                                  "a part of the figure may be missing: look at the mask (skel-label FILE)"};
  for (const char* warning : warnings) {
    CAPTURE(warning);
    drawing.silhouette.evidence.reset();
    const std::string tidy = advice(warning);
    CHECK_THAT(tidy, Contains("skel-label 'class/Eva B.png'"));
    CHECK_THAT(tidy, !Contains("felt pen") && !Contains("shadow"));
    drawing.silhouette.evidence.emplace();
    CHECK_THAT(advice(warning), Contains("shadow") && Contains("skel-label 'class/Eva B.png'"));
    CHECK_THAT(advice(warning), !Contains("Person"));
  }
  drawing.body_plan.name = "quadruped";
  CHECK_THAT(advice(warnings[0]), Contains("choose Person ("));
}

TEST_CASE("the report of all figures counted them as drawings") {
  const TempDir dir;
  const Image one = capsuleImage();
  Image two(2 * one.width, one.height);
  for (int y = 0; y < two.height; ++y)
    for (int x = 0; x < two.width; ++x) std::copy_n(one.pixel(x % one.width, y), 4, two.pixel(x, y));
  writeFile(dir.file("class/Ann.png"), encodePng(one));
  writeFile(dir.file("class/Two.png"), encodePng(two));
  const ToolRun run = infer(dir, "class -o class --formats json --figure all --report class/report.html");
  CHECK_THAT(run.err, Contains("3 figures: "));
  CHECK_THAT(readFile(dir.file("class/report.html")), Contains("<title>3 figures, moving</title>"));
}

TEST_CASE("a printed report shows the figures at rest") {
  const TempDir dir;
  const std::string html = reportOf(dir, "--clips wave"), print = html.substr(html.find("@media print"));
  CHECK(countIn(html, "<img class=\"rest\"") == 2);
  CHECK(countIn(html, ", at rest\" src=\"data:image/") == 2);
  CHECK_THAT(print,
             Contains(".film > div { display: none; }") && Contains(".film > .rest { display: block; }"));
}

TEST_CASE("a report does not go over a result of its own run") {
  const TempDir dir;
  writeFile(dir.file("boy.png"), encodePng(capsuleImage()));
  for (const char* report : {"o/boy.glb", "./x/../o/boy.skeleton.json"}) {
    const ToolRun run = infer(dir, std::string("boy.png -o o --report ") + report);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("is to be written twice, also as the report; name another --report"));
  }
  CHECK_FALSE(std::filesystem::exists(dir.file("o")));
}

TEST_CASE("names in the report are text, whatever stands in them") {
  const TempDir dir;
  const std::string html = reportOf(dir);
  CHECK_THAT(html, Contains("<h2>&lt;b&gt;Tom &amp; &quot;Jerry&quot;</h2>"));
  CHECK(html.find("<b>") == html.npos);
}

TEST_CASE("the report needs nothing from elsewhere, runs no script and is the same each time") {
  const TempDir dir;
  const std::string html = reportOf(dir);
  for (const char* foreign : {"http://", "https://", "<script", "url(", "@import", "<link", "file:"})
    CHECK(html.find(foreign) == html.npos);
  CHECK_THAT(html, Contains("default-src 'none'; img-src data:"));
  CHECK(reportOf(dir) == html);
}

TEST_CASE("the report shows the clip that was asked for, or the drawing alone where there is none") {
  const TempDir dir;
  CHECK(reportOf(dir, "--clips walk") != reportOf(dir, "--clips jump"));
  const std::string still = reportOf(dir, "--clips none");
  CHECK(countIn(still, "class=\"drawing\"") == 2);
  CHECK(countIn(still, "class=\"film\"") == 0);
}

TEST_CASE("a photo that a pattern of the shell makes the report's name is not written over") {
  const TempDir dir;
  std::filesystem::copy(kDrawing, dir.file("a.png"));
  writeFile(dir.file("Ben.JPG"), "his photo");
  const ToolRun run = infer(dir, "a.png --report Ben.JPG");
  CHECK(run.exit_code == 4);
  CHECK_THAT(run.err,
             Contains("Ben.JPG: is no page, and would be written over; name a file that ends in .html"));
  CHECK(readFile(dir.file("Ben.JPG")) == "his photo");
}

TEST_CASE("a drawing is not written over by the report") {
  const TempDir dir;
  writeFile(dir.file("a.png"), readFile(kDrawing));
  CHECK(infer(dir, "a.png --report a.png").exit_code == 1);
  CHECK(readFile(dir.file("a.png")) == readFile(kDrawing));
}
