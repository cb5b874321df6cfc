// Lists of drawings: any number of them, in parts, by many machines, gone on with after a crash.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "infer/class_table.h"
#include "infer/drawing_list.h"
#include "infer/result_file.h"
#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "tests/infer/run_infer.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

std::string figure(int size = 200) {
  CapsuleFigure capsules;
  capsules.size = size;
  return encodePng(capsuleImage(capsules));
}

const std::string kCheap = " --formats json --clips none ";

std::vector<Json> lines(const std::string& text) {
  std::vector<Json> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(Json::parse(line));
  return all;
}

// By source: "done", "failed", "left out"; "kept" before the first two where an earlier run has done it.
std::map<std::string, std::string> statuses(const ToolRun& run) {
  std::map<std::string, std::string> all;
  for (const Json& line : lines(run.out)) {
    const std::string kept = line["kept"].get<bool>() ? "kept " : "";
    CHECK(all.emplace(line["source"], kept + line["status"].get<std::string>()).second);
  }
  return all;
}

using Statuses = std::map<std::string, std::string>;

void writeTree(const TempDir& dir) {
  for (const char* name : {"in/a/hero.png", "in/b/hero.png", "in/b/other.png"})
    writeFile(dir.file(name), figure());
  writeFile(dir.file("list"), "in/a/hero.png\n\nin/b/hero.png\nin/b/other.png\n");
}

}  // namespace

TEST_CASE("a list is rigged in its order, and results lie as the drawings lie") {
  const TempDir dir;
  writeTree(dir);
  const ToolRun run = infer(dir, "--from list -o out" + kCheap);
  CAPTURE(run.err);
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.out, Contains("in/a/hero.png: out/in/a/hero.skeleton.json  confidence"));
  CHECK(run.out.find("in/a/") < run.out.find("in/b/hero"));
  CHECK(run.out.find("in/b/hero") < run.out.find("in/b/other"));
  CHECK_THAT(run.err, Contains("3 drawings: "));
  for (const char* name : {"in/a/hero", "in/b/hero", "in/b/other"}) {
    CHECK(fs::exists(dir.file(std::string("out/") + name + ".skeleton.json")));
    CHECK(fs::exists(dir.file(std::string("out/") + name + ".result.json")));
  }
  SECTION("out of a pipe, with zero bytes between, it is the same") {
    const ToolRun piped = runTool("cd '" + dir.path() +
                                  "' && tr '\\n' '\\0' <list | skel-infer --from - --null -o two" + kCheap);
    CHECK(piped.exit_code == 0);
    CHECK(readFile(dir.file("two/in/b/other.skeleton.json")) ==
          readFile(dir.file("out/in/b/other.skeleton.json")));
  }
  SECTION("what lies in the folder of the results is left out") {
    writeFile(dir.file("out/in/a/hero.overlay.png"), figure());
    writeFile(dir.file("in/a/hero.mask.png"), figure());
    writeFile(dir.file("all"), "in/a/hero.png\nout/in/a/hero.overlay.png\nin/a/hero.mask.png\n");
    fs::remove(dir.file("in/a/hero.mask.png"));
    const ToolRun some = infer(dir, "--from all --json -o out" + kCheap);
    CHECK(some.exit_code == 0);
    CHECK(statuses(some) == Statuses{{"in/a/hero.png", "done"},
                                     {"in/a/hero.mask.png", "left out"},
                                     {"out/in/a/hero.overlay.png", "left out"}});
    CHECK_THAT(some.err, Contains("left out of the list, as they are results: 2, the first is"));
    const ToolRun none = infer(dir, "--from list -o ." + kCheap);
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.err, Contains("in/a/hero.png and all others of the list lie in the folder of the "
                                  "results, ., or were made of drawings; name another folder by -o"));
  }
}

TEST_CASE("a line of JSON says all that became of a drawing, in the order of the list") {
  const TempDir dir;
  writeTree(dir);
  writeFile(dir.file("in/text.png"), "no picture");
  writeFile(dir.file("list"), readFile(dir.file("list")) + "in/text.png\nin/nowhere.png\n");
  const ToolRun run = infer(dir, "--from list --json --jobs 4 -o out" + kCheap);
  CHECK(run.exit_code == 2);
  const std::vector<Json> all = lines(run.out);
  REQUIRE(all.size() == 5);
  const Json& first = all[0];
  CHECK(first["source"] == "in/a/hero.png");
  CHECK(first["status"] == "done");
  CHECK(first["skel"] == SKEL_VERSION);
  for (const char* hash : {"image", "options", "nets"})
    CHECK(first["sha256"][hash].get<std::string>().size() == 64);
  CHECK(first["sha256"]["mended"] == "");
  const Json& only = first["figures"][0];
  CHECK(only["confidence"].get<double>() > .5);
  CHECK(only["template"] == "biped");
  CHECK(only["missing"].is_array());
  CHECK(only["times_ms"].size() > 3);
  CHECK(only["outputs"][0]["file"] == "out/in/a/hero.skeleton.json");
  CHECK(only["outputs"][0]["bytes"] == fs::file_size(dir.file("out/in/a/hero.skeleton.json")));
  CHECK(all[2]["source"] == "in/b/other.png");
  CHECK(all[3]["status"] == "failed");
  CHECK(all[3]["code"] == 2);
  CHECK_THAT(all[3]["error"].get<std::string>(), Contains("in/text.png: is not a picture"));
  CHECK_THAT(all[4]["error"].get<std::string>(), Contains("in/nowhere.png: cannot be read"));
  CHECK_THAT(run.err, Contains("skel-infer: in/text.png: is not a picture"));
  SECTION("drawings that are named get the same lines, without files for a later run") {
    const ToolRun named = infer(dir, "in/a/hero.png in/b/other.png --json -o flat" + kCheap);
    CHECK(lines(named.out).at(0)["sha256"] == first["sha256"]);
    CHECK_FALSE(fs::exists(dir.file("flat/hero.result.json")));
  }
  SECTION("one whose result cannot be kept has failed, and says what was written all the same") {
    fs::create_directories(dir.file("full/in/a/hero.result.json"));
    const ToolRun failed = infer(dir, "--from list --json -o full" + kCheap);
    CHECK(failed.exit_code == 4);
    const Json one = lines(failed.out).at(0);
    CHECK(one["status"] == "failed");
    CHECK_THAT(one["error"].get<std::string>(), Contains("hero.result.json: cannot be written: "));
    CHECK(one["figures"].size() == 1);
  }
  SECTION("a report adds no line that is no JSON") {
    const ToolRun reported = infer(dir, "in/a/hero.png --json --report r.html -o flat" + kCheap);
    CHECK(lines(reported.out).size() == 1);
    CHECK(fs::exists(dir.file("r.html")));
  }
}

TEST_CASE("what is done is left, what is half done or was made otherwise is done anew") {
  const TempDir dir;
  writeTree(dir);
  const std::string run = "--from list --json --resume -o out" + kCheap;
  const Statuses all_done = {
      {"in/a/hero.png", "done"}, {"in/b/hero.png", "done"}, {"in/b/other.png", "done"}};
  const Statuses all_kept = {
      {"in/a/hero.png", "kept done"}, {"in/b/hero.png", "kept done"}, {"in/b/other.png", "kept done"}};
  Statuses but_one = all_kept;
  but_one["in/a/hero.png"] = "done";
  const std::string skeleton = dir.file("out/in/a/hero.skeleton.json");
  const ToolRun first = infer(dir, run);
  REQUIRE(statuses(first) == all_done);
  const auto isMadeAnew = [&] {
    CHECK(statuses(infer(dir, run)) == but_one);
    CHECK(statuses(infer(dir, run)) == all_kept);
  };
  SECTION("nothing has changed") {
    const auto written = fs::last_write_time(skeleton);
    const ToolRun again = infer(dir, run);
    CHECK(statuses(again) == all_kept);
    CHECK(fs::last_write_time(skeleton) == written);
    CHECK_THAT(again.err, Contains("; 3 done before"));
    CHECK_THAT(
        infer(dir, "--from list --resume -o out" + kCheap).out,
        Contains("in/b/hero.png: out/in/b/hero.skeleton.json  confidence") && Contains("(done before)"));
    auto before = lines(first.out), after = lines(again.out);
    for (auto* some : {&before, &after})
      for (Json& line : *some) line.erase("kept");
    CHECK(before == after);
  }
  SECTION("without --resume all are, and the next run with it goes on from there") {
    CHECK(statuses(infer(dir, "--from list --json -o out" + kCheap)) == all_done);
    CHECK(statuses(infer(dir, run)) == all_kept);
  }
  SECTION("killed before its result file was there") {
    fs::remove(dir.file("out/in/a/hero.result.json"));
    isMadeAnew();
  }
  SECTION("a result file is cut off") {
    const std::string path = dir.file("out/in/a/hero.result.json");
    writeFile(path, readFile(path).substr(0, 100));
    isMadeAnew();
  }
  SECTION("an output is gone") {
    fs::remove(skeleton);
    isMadeAnew();
  }
  SECTION("an output is another") {
    writeFile(skeleton, readFile(skeleton) + " ");
    isMadeAnew();
  }
  SECTION("the drawing has changed") {
    writeFile(dir.file("in/a/hero.png"), figure(220));
    isMadeAnew();
  }
  SECTION("a mask was painted") {
    Plane8 mask = Plane8::Zero(200, 200);
    mask.block(20, 60, 160, 80).setConstant(255);
    writeFile(dir.file("in/a/hero.mask.png"), encodePng(mask));
    isMadeAnew();
  }
}

TEST_CASE("other options make a drawing anew, but not those that say where, how fast and how loud") {
  const TempDir dir;
  writeFile(dir.file("hero.png"), figure());
  const auto status = [&](const std::string& options) {
    return statuses(infer(dir, "hero.png --json --resume" + kCheap + options)).at("hero.png");
  };
  CHECK(status("") == "done");
  CHECK(status("--jobs 3 --quiet --timings") == "kept done");
  CHECK(status("--upright") == "done");
  CHECK(status("--upright") == "kept done");
  CHECK(status("") == "done");
  SECTION("a file that an option names counts by what is in it") {
    const std::string weights = SKEL_SOURCE_DIR "/weights/default.json";
    writeFile(dir.file("w.json"), readFile(weights));
    CHECK(status("--weights w.json") == "done");
    CHECK(status("--weights " + weights) == "kept done");
    writeFile(dir.file("w.json"), readFile(weights) + "\n");
    CHECK(status("--weights w.json") == "done");
  }
}

TEST_CASE(
    "a drawing that is none is told again by the run that goes on, and what the machine lacked is tried "
    "again") {
  const TempDir dir;
  writeFile(dir.file("in/text.png"), "no picture");
  writeFile(dir.file("list"), "in/text.png\nin/late.png\n");
  const std::string run = "--from list --json --resume -o out" + kCheap;
  CHECK(statuses(infer(dir, run)) == Statuses{{"in/text.png", "failed"}, {"in/late.png", "failed"}});
  writeFile(dir.file("in/late.png"), figure());
  const ToolRun again = infer(dir, run);
  CHECK(statuses(again) == Statuses{{"in/text.png", "kept failed"}, {"in/late.png", "done"}});
  CHECK(again.exit_code == 2);
  CHECK_THAT(again.err, Contains("in/text.png: is not a picture"));
}

TEST_CASE("a run that goes on forgot that a blank sheet is to be taken again") {
  const TempDir dir;
  writeFile(dir.file("class/blank.png"), encodePng(Plane8::Constant(200, 200, 255)));
  writeFile(dir.file("class/hero.png"), figure());
  const std::string run = "class --resume -o out" + kCheap;
  for (const char* counts : {"2 drawings: 1 fine, 1 to retake\n", "1 to retake; 2 done before\n"})
    CHECK_THAT(infer(dir, run).err,
               Contains(counts) && Contains("retake class/blank.png: nothing was found on it\n"));
}

TEST_CASE("a run that went on after the folder was moved named files where they had been") {
  const TempDir dir;
  writeFile(dir.file("class/text.png"), "no picture");
  writeFile(dir.file("class/hero.png"), figure());
  Plane8 mask = Plane8::Zero(200, 200);
  mask.block(20, 60, 160, 80).setConstant(255);
  writeFile(dir.file("class/hero.mask.png"), encodePng(mask));
  const std::string run = " --resume" + kCheap;
  infer(dir, "class -o class/out" + run);
  fs::rename(dir.file("class"), dir.file("moved"));
  const ToolRun moved = infer(dir, "moved -o moved/out" + run);
  CHECK_THAT(moved.err, Contains("skel-infer: moved/text.png: is not a picture") &&
                            Contains("mask (moved/hero.mask.png)") && Contains("; 1 done before"));
  CHECK(moved.err.find("class/") == std::string::npos);
}

TEST_CASE("joints that were moved by hand in a result are taken up when a run goes on") {
  const TempDir dir;
  fs::copy(kDrawing, dir.file("hero.png"));
  writeFile(dir.file("list"), "hero.png\n");
  const std::string run = "--from list --json --resume -o out" + kCheap,
                    path = dir.file("out/hero.skeleton.json");
  REQUIRE(infer(dir, run).exit_code == 0);
  std::string text = readFile(path);
  const size_t hand = text.find("\"left_hand\""), x = text.find("\"image\":[", hand) + 9;
  writeFile(path, text.replace(x, text.find(',', x) - x, "420.5"));
  CHECK(statuses(infer(dir, run)).at("hero.png") == "done");
  CHECK_THAT(readFile(path), Contains("\"edited\""));
  CHECK(statuses(infer(dir, run)).at("hero.png") == "kept done");
}

TEST_CASE("parts of a list are all of it, each drawing once, and a part may be another when a run goes on") {
  const TempDir dir;
  writeTree(dir);
  Statuses all;
  for (const char* part : {"1/2", "2/2"})
    for (const auto& [source, status] : statuses(
             infer(dir, "--from list --json --resume -o out" + kCheap + std::string("--shard ") + part))) {
      CHECK(all.emplace(source, status).second);
      CHECK(status == "done");
    }
  CHECK(all.size() == 3);
  CHECK(statuses(infer(dir, "--from list --json --resume -o out --shard 3/3" + kCheap)) ==
        Statuses{{"in/b/other.png", "kept done"}});
  CHECK(infer(dir, "--from list --json -o out --shard 9/9" + kCheap).out.empty());
}

TEST_CASE("two drawings whose results would have the same names: the second is refused, whatever runs them") {
  const TempDir dir;
  writeFile(dir.file("in/hero.png"), figure());
  writeFile(dir.file("in/hero.PNG"), figure(220));
  writeFile(dir.file("list"), "in/hero.png\nin/hero.PNG\n");
  const ToolRun run = infer(dir, "--from list --json -o out" + kCheap);
  CHECK(run.exit_code == 2);
  CHECK(statuses(run) == Statuses{{"in/hero.png", "done"}, {"in/hero.PNG", "failed"}});
  CHECK_THAT(run.err, Contains("in/hero.PNG: its results would take the place of those of in/hero.png; "
                               "rename one of the two, or delete out/in/hero.result.json"));
  fs::remove(dir.file("in/hero.png"));
  CHECK(statuses(infer(dir, "--from list --json -o out" + kCheap)).at("in/hero.PNG") == "done");
  SECTION("the same drawing twice is done once") {
    writeFile(dir.file("list"), "in/hero.PNG\n./in/hero.PNG\n");
    CHECK(statuses(infer(dir, "--from list --json --resume -o out --jobs 2" + kCheap)) ==
          Statuses{{"in/hero.PNG", "kept done"}, {"./in/hero.PNG", "kept done"}});
  }
}

TEST_CASE("a picture comes from the standard input, out of a file or a pipe") {
  const TempDir dir;
  writeFile(dir.file("x.png"), figure());
  REQUIRE(infer(dir, "x.png -o named --name hero" + kCheap).exit_code == 0);
  const auto joints = [&](const std::string& folder) {
    return Json::parse(readFile(dir.file(folder + "/hero.skeleton.json")))["joints"];
  };
  CHECK(infer(dir, "- -o file --name hero" + kCheap + "<x.png").exit_code == 0);
  CHECK(joints("file") == joints("named"));
  const ToolRun piped =
      runTool("cd '" + dir.path() + "' && cat x.png | skel-infer - -o pipe --json --name hero" + kCheap);
  CHECK(piped.exit_code == 0);
  CHECK(joints("pipe") == joints("named"));
  CHECK(lines(piped.out).at(0)["source"] == "/dev/stdin");
  CHECK(infer(dir, "- -o nameless" + kCheap + "<x.png").exit_code == 0);
  CHECK(fs::exists(dir.file("nameless/stdin.skeleton.json")));
}

TEST_CASE("what makes no sense of many drawings is refused in one sentence") {
  const TempDir dir;
  writeTree(dir);
  const auto refusal = [&](const std::string& options) {
    const ToolRun run = infer(dir, options + kCheap);
    CHECK(run.exit_code == 1);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    return run.err;
  };
  CHECK_THAT(refusal("--from list --report r.html"), Contains("--report holds pictures of all drawings"));
  CHECK_THAT(refusal("--from list --trace t"), Contains("--trace draws every stage"));
  CHECK_THAT(refusal("--from list --mask in/a/hero.png"), Contains("--mask goes with one image, not with"));
  CHECK_THAT(refusal("--from list --name x"), Contains("--name goes with one image, not with --from"));
  CHECK_THAT(refusal("--from list in/a/hero.png"), Contains("--from names the drawings; name none beside"));
  CHECK_THAT(refusal("in/a/hero.png in/b/other.png --name x"),
             Contains("--name goes with one image, 2 were"));
  CHECK_THAT(refusal("in/a/hero.png --name a/b"), Contains("which is no name for files; \"a_b\" is one"));
  CHECK_THAT(refusal("in/a/hero.png --shard 1/2"), Contains("--shard is a part of the list of --from"));
  CHECK_THAT(refusal("in/a/hero.png --null"), Contains("--null says how the list"));
  for (const char* part : {"0/2", "3/2", "2", "a/b", "1/2/3", "-1/2", "1/"})
    CHECK_THAT(refusal("--from list --shard " + std::string(part)), Contains("must be I/N"));
}

TEST_CASE("a list that is none is refused by name") {
  const TempDir dir;
  writeFile(dir.file("zeros"), std::string("a.png\0b.png\0", 12));
  writeFile(dir.file("long"), std::string(100000, 'x'));
  const auto refusal = [&](const std::string& list) {
    const ToolRun run = infer(dir, "--from " + list + kCheap);
    CHECK(run.exit_code == 2);
    return run.err;
  };
  CHECK_THAT(refusal("nowhere"), Contains("nowhere: cannot be read: "));
  CHECK_THAT(refusal("."), Contains(".: cannot be read: "));
  CHECK_THAT(refusal("zeros"), Contains("zeros: path 1 holds a zero byte"));
  CHECK_THAT(refusal("long"), Contains("long: path 1 is longer than 4096 bytes"));
  CHECK_THAT(refusal("/dev/zero --null"),
             Contains("/dev/zero: path 1 comes after more than 100000 empty ones"));
}

TEST_CASE("results stay below their folder, whatever the path of the drawing") {
  CHECK(stemInTree("a/b.png") == "a/b");
  CHECK(stemInTree("/data/a/b.tar.png") == "data/a/b.tar");
  CHECK(stemInTree("../../x/./y.png") == "x/y");
  CHECK(stemInTree("a/../../b.png") == "b");
  CHECK(stemInTree("a//b") == "a/b");
  CHECK(stemInTree("a/...png") == "a/...png");
  for (const char* nothing : {"/", "..", "../..", "."}) CHECK_THROWS_AS(stemInTree(nothing), InputError);
}

TEST_CASE("a result is read as it was written") {
  const TempDir dir;
  DrawingResult drawing;
  drawing.source = dir.file("in/a\xff.png");
  drawing.origin = {"i", "", "o", "n", "1.0"};
  drawing.error = drawing.source + ": is cut";
  drawing.code = ExitCode::kInput;
  FigureResult one;
  one.number = 2;
  one.confidence = .25;
  one.body_plan = "biped";
  one.verdict = Verdict::kRetake;
  one.missing = {"left_hand"};
  one.reasons = {"look"};
  one.notes = {{"all of it", "all", "it"}, {"alone"}};
  one.outputs = {{dir.file("out/a.glb"), 12, "ab"}};
  one.times = {{"mesh", .125}};
  drawing.figures = {one};
  const std::string path = dir.file("out/a.result.json"), text = formatResult(drawing, path);
  CHECK(text.find('\n') == text.npos);
  const DrawingResult again = parseResult(text, path);
  CHECK(again.source == drawing.source);
  CHECK(again.origin == drawing.origin);
  CHECK(again.error == drawing.error);
  CHECK(again.problem == "is cut");
  CHECK(again.figures.at(0).outputs.at(0).path == dir.file("out/a.glb"));
  CHECK(formatResult(again, path) == text);
}

TEST_CASE("a table about a list names some drawings of each sentence and counts the others") {
  ClassTable few(false, 3);
  for (int i = 0; i < 20000; ++i) {
    DrawingResult drawing;
    drawing.source = std::to_string(i) + ".png";
    FigureResult figure;
    figure.verdict = Verdict::kLookAt;
    figure.reasons = {"not found: left_hand", "seen " + std::to_string(i) + " times"};
    drawing.figures = {figure};
    few.add(drawing);
  }
  CHECK_THAT(few.text(), Contains("20000 drawings: 0 fine, 20000 to look at\n") &&
                             Contains("look at 0.png 1.png 2.png and 19997 more: not found: left_hand\n") &&
                             Contains("and 19701 times something else\n"));
  CHECK(few.text().size() < 20000);
}
