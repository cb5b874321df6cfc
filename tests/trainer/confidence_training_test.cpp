// What confidence is learned from, and skel-train confidence as a user runs it.
#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/layer_map.h"
#include "libskel/layers/limb_net.h"
#include "libskel/recognition/confidence_model.h"
#include "libskel/recognition/facing_net.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/silhouette/loops.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "trainer/confidence_samples.h"
#include "trainer/confidence_table.h"

namespace skel {
namespace {

std::string folderOf(const TempDir& dir, const std::string& folder, const std::string& set,
                     const std::vector<std::string>& names) {
  std::filesystem::create_directories(dir.file(folder));
  for (const std::string& name : names)
    for (const char* end : {".png", ".mask.png", ".joints.json"})
      std::filesystem::copy_file(SKEL_DATASETS "/" + set + "/" + name + end,
                                 dir.file(folder + "/" + name) + end);
  return dir.file(folder);
}

TEST_CASE("samples of drawings that the net knows well are right, cut ones and pairs never usable") {
  const TempDir dir;
  const std::string folder = folderOf(dir, "d", "characters", {"cap_boy", "ninja"});
  const std::vector<JointedDrawing> drawings = findJointedDrawings(folder),
                                    animals =
                                        findJointedDrawings(folderOf(dir, "a", "animals", {"walking_dog"}));
  const std::vector<ConfidenceSample> samples =
      confidenceSamples(drawings, animals, builtInJointNets().of("biped"), 2, 1, 2);
  const auto count = [&](Disturbance disturbance) {
    return std::count_if(samples.begin(), samples.end(),
                         [&](const ConfidenceSample& s) { return s.disturbance == disturbance; });
  };
  CHECK(count(Disturbance::kNone) == 2);
  CHECK(count(Disturbance::kOtherPlan) == 1);
  for (const Disturbance disturbance : {Disturbance::kWarped, Disturbance::kTurned, Disturbance::kThing,
                                        Disturbance::kLimb, Disturbance::kBite, Disturbance::kCut})
    CHECK(count(disturbance) == 4);
  for (const ConfidenceSample& s : samples) {
    INFO(s.drawing << " " << static_cast<int>(s.disturbance));
    CHECK(s.right.size() == 14);
    if (s.disturbance == Disturbance::kNone) {
      CHECK(s.usable);
      CHECK(std::count(s.right.begin(), s.right.end(), 1) == 14);
    }
    const bool whole = s.disturbance != Disturbance::kCut && s.disturbance != Disturbance::kPair &&
                       s.disturbance != Disturbance::kOtherPlan;
    if (!whole) CHECK(!s.usable);
    if (!whole) CHECK(std::count(s.right.begin(), s.right.end(), -1) == 14);
  }
}

TEST_CASE(
    "confidence is learned to the same bytes whatever the number of threads, and is measured on hands left "
    "out") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters", {"cap_boy", "ninja", "pirate"}),
                    animals = folderOf(dir, "a", "animals", {"walking_dog"});
  writeFile(dir.file("hands.json"), R"({"first": ["ninja"], "second": ["cap_boy"], "third": ["pirate"]})");
  const auto run = [&](const std::string& output, const std::string& more) {
    return runTool("skel-train confidence --biped '" + people + "' --quadruped '" + animals + "' --hands '" +
                   dir.file("hands.json") + "' --copies 1 --folds 2 -o '" + dir.file(output) + "' " + more);
  };
  const auto one = run("one.json", "--threads 1 --table '" + dir.file("table.csv") + "'");
  INFO(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.find("on hands left out") != std::string::npos);
  REQUIRE(run("three.json", "--threads 3").exit_code == 0);
  CHECK(readFile(dir.file("one.json")) == readFile(dir.file("three.json")));
  CHECK(parseConfidenceModel(readFile(dir.file("one.json")), "one.json").joint.hidden.rows() > 0);
  const std::string table = readFile(dir.file("table.csv"));
  CHECK(table.find("ninja,none,biped,") != std::string::npos);
  CHECK(table.find("walking_dog,other plan,biped,") != std::string::npos);

  REQUIRE(run("second.json", "--first-hand second --table '" + dir.file("table.csv") + "'").exit_code == 0);
  CHECK(readFile(dir.file("table.csv")).find("ninja") == std::string::npos);
  CHECK(readFile(dir.file("second.json")) != readFile(dir.file("one.json")));
  const auto nobody = run("n.json", "--first-hand nobody");
  CHECK(nobody.exit_code == 1);
  CHECK(nobody.err.find("knows no such hand") != std::string::npos);
}

namespace {

ToolRun trainOnPages(const std::string& command, const std::string& people, const std::string& output,
                     const std::string& more) {
  return runTool("skel-train " + command + " '" + people + "' --folds 2 -o '" + output + "' " + more);
}

// one.json by one thread, which says `words`, and three.json by three are the same.
void learnOnPages(const TempDir& dir, const std::string& command, const std::string& people,
                  const std::string& words) {
  const ToolRun one = trainOnPages(command, people, dir.file("one.json"), "--threads 1");
  INFO(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.find(words) != std::string::npos);
  REQUIRE(trainOnPages(command, people, dir.file("three.json"), "--threads 3").exit_code == 0);
  CHECK(readFile(dir.file("one.json")) == readFile(dir.file("three.json")));
}

}  // namespace

TEST_CASE(
    "what tells how sure a silhouette is, is learned to the same bytes whatever the number of threads, and "
    "nothing is learned where it cannot be written") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters", {"cap_boy", "ninja", "pirate"});
  learnOnPages(dir, "silhouettes", people, "on hands left out");
  CHECK(parseSilhouetteConfidence(readFile(dir.file("one.json")), "one.json").net.hidden.rows() > 0);
  const auto folder = trainOnPages("silhouettes", people, people, "");
  CHECK(folder.exit_code == 4);
  CHECK(folder.out.empty());
}

TEST_CASE("drawings of one picture were learned from and measured on, by two hands") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters", {"cap_boy"});
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(people + "/cap_boy" + end, people + "/twin" + end);
  const ToolRun one = trainOnPages("silhouettes", people, dir.file("one.json"), "");
  CHECK(one.exit_code == 0);
  CHECK(one.err.find("skel-train: note: 2 drawings are one picture (" + people + "/cap_boy.png, " + people +
                     "/twin.png): they are left out together\n") != std::string::npos);
  CHECK(one.out.find("\nall" + std::string(12, ' ') + "0 pages,") != std::string::npos);  // of no other hand
}

TEST_CASE("which loops are ground is learned to the same bytes whatever the number of threads") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters", {"cap_boy", "ninja", "pirate"});
  learnOnPages(dir, "loops", people, "are ground");
  CHECK(parseLoopNet(readFile(dir.file("one.json")), "one.json").net.hidden.rows() > 0);
}

TEST_CASE("what is a limb is learned to the same bytes whatever the number of threads") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters", {"cap_boy", "ninja", "pirate"});
  // Each part of what is found by their joints a shape.
  const SkeletonTemplate body_plan = loadTemplate("biped");
  for (const JointedDrawing& drawing : findJointedDrawings(people)) {
    const Image image = readImage(drawing.image);
    Skeleton skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
    for (const auto& [name, place] : drawing.joints) {
      Joint& joint = skeleton.joints[std::size_t(skeleton.index(name))];
      joint.image = *place, joint.confidence = 1;
    }
    const Silhouette silhouette = silhouetteOf(image, drawing);
    const LayerMap found = findLayers(image, silhouette, skeleton, body_plan, builtInPartNet());
    Image shapes(image.width, image.height);
    for (int y = 0; y < shapes.height; ++y)
      for (int x = 0; x < shapes.width; ++x) {
        std::uint8_t* p = shapes.pixel(x, y);
        p[0] = silhouette.mask(y, x) == 0 ? 0 : std::uint8_t(1 + found.part(y, x));
        p[1] = p[2] = 0, p[3] = 255;
      }
    writeFile(dir.file("shapes/p/" + drawingName(drawing.image) + ".shapes.png"), encodePng(shapes));
  }
  const auto learn = [&](const std::string& output, const std::string& more) {
    return runTool("skel-train limbs '" + people + "' --shapes '" + dir.file("shapes") + "' --folds 2 -o '" +
                   dir.file(output) + "' " + more);
  };
  const ToolRun one = learn("one.json", "--threads 1");
  INFO(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.find("are limbs") != std::string::npos);
  REQUIRE(learn("three.json", "--threads 3").exit_code == 0);
  CHECK(readFile(dir.file("one.json")) == readFile(dir.file("three.json")));
  CHECK(parseLimbNet(readFile(dir.file("one.json")), "one.json").net.hidden.rows() == 0);
  const ToolRun nothing =
      runTool("skel-train limbs '" + people + "' --shapes '" + people + "' -o '" + dir.file("n.json") + "'");
  CHECK(nothing.exit_code == 1);
  CHECK(nothing.err.find("no drawings with shapes") != std::string::npos);
}

TEST_CASE("which way figures look is learned to the same bytes whatever the number of threads") {
  const TempDir dir;
  const std::string people = folderOf(dir, "p", "characters",
                                      {"alien", "astro_float", "backpack_boy", "cap_boy", "ninja", "pirate"});
  const auto learn = [&](const std::string& output, const std::string& more) {
    return runTool("skel-train facing '" + people + "' --folds 2 -o '" + dir.file(output) + "' " + more);
  };
  const ToolRun one = learn("one.json", "--threads 1");
  INFO(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out.find("turned") != std::string::npos);
  REQUIRE(learn("three.json", "--threads 3").exit_code == 0);
  CHECK(readFile(dir.file("one.json")) == readFile(dir.file("three.json")));
  CHECK(parseFacingNet(readFile(dir.file("one.json")), "one.json").right.hidden.rows() == 0);
  std::filesystem::remove(dir.file("p/astro_float.joints.json"));
  writeFile(dir.file("p/astro_float.joints.json"), R"({"joints": {"head": [1, 2]}, "facing_deg": "left"})");
  CHECK(learn("bad.json", "").err.find("facing_deg") != std::string::npos);
}

TEST_CASE("a table of samples is read again as it was written, and what is none is refused by its line") {
  const TempDir dir;
  std::vector<ConfidenceSample> samples =
      confidenceSamples(findJointedDrawings(folderOf(dir, "d", "characters", {"cap_boy"})), {},
                        builtInJointNets().of("biped"), 0, 1, 1);
  REQUIRE(!samples.empty());
  samples[0].drawing = "Ann, 7 %\n(2).png";
  const std::string table = formatConfidenceTable(samples);
  const std::vector<ConfidenceSample> read = parseConfidenceTable(table, "t.csv");
  CHECK(formatConfidenceTable(read) == table);
  REQUIRE(read.size() == samples.size());
  CHECK(read[0].drawing == samples[0].drawing);
  CHECK(read[0].right == samples[0].right);
  CHECK(read[0].evidence.counts == samples[0].evidence.counts);
  CHECK((read[0].evidence.joints - samples[0].evidence.joints).abs().maxCoeff() < 1e-3);
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      parseConfidenceTable(text, "t.csv");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  // The line of the format is not in tables from before there were versions.
  const std::size_t versioned = table.find('\n') + 1;
  CHECK(table.substr(0, versioned) == "skel-confidence-table,1\n");
  const std::string old = table.substr(versioned);
  CHECK(formatConfidenceTable(parseConfidenceTable(old, "t.csv")) == table);
  CHECK(formatConfidenceTable(parseConfidenceTable(table + table, "t.csv")) == table + old);
  CHECK(complaint("skel-confidence-table,2\n") ==
        "t.csv: line 1: version is 2, this program reads up to 1; use a newer skel");
  for (const std::string version : {"0", "-1", "0.5", "x", "", "1,1"})
    CHECK(complaint("skel-confidence-table," + version + "\n") ==
          "t.csv: line 1 is none of a table that skel-train confidence writes");
  constexpr const char* kSecond = "t.csv: line 2 is none of a table that skel-train confidence writes";
  const std::string first = old.substr(0, old.find('\n') + 1);
  CHECK(complaint(first).empty());
  CHECK(complaint(first + "J,a,none,biped,1,nan\n") == kSecond);
  CHECK(complaint(first + first.substr(0, first.rfind(',')) + "\n") == kSecond);
  CHECK(complaint("J" + first.substr(1)) ==
        "t.csv: line 1 is none of a table that skel-train confidence writes");
  // What is neither right nor wrong nor unknown; more joints than any net has.
  std::string joint = old.substr(first.size(), old.find('\n', first.size()) + 1 - first.size());
  std::string all = first;
  for (int i = 0; i < 63; ++i) all += joint;
  CHECK(complaint(all).empty());
  CHECK(complaint(all + joint) == "t.csv: line 65 is none of a table that skel-train confidence writes");
  joint.replace(joint.find("biped,") + 6, 1, "1e300");
  CHECK(complaint(first + joint) == kSecond);
}

TEST_CASE("a table of figures without joints, or of joints that nobody knows, is one line") {
  const TempDir dir;
  std::vector<ConfidenceSample> samples =
      confidenceSamples(findJointedDrawings(folderOf(dir, "d", "characters", {"cap_boy"})), {},
                        builtInJointNets().of("biped"), 0, 1, 1);
  const auto refused = [&](const std::string& table, int exit_code, const std::string& message) {
    writeFile(dir.file("t.csv"), table);
    const auto run =
        runTool("skel-train confidence '" + dir.file("t.csv") + "' -o '" + dir.file("c.json") + "'");
    CHECK(run.exit_code == exit_code);
    CHECK(run.err == "skel-train: " + message + "\n");
    CHECK_FALSE(std::filesystem::exists(dir.file("c.json")));
  };
  const std::string table = formatConfidenceTable(samples);
  const std::size_t figure = table.find("\nF,") + 1;
  refused(table.substr(0, table.find('\n', figure) + 1), 2,
          dir.file("t.csv") + ": has no joint that counts of \"" + samples[0].drawing + "\"");
  for (ConfidenceSample& s : samples) s.right.assign(s.right.size(), -1);
  refused(formatConfidenceTable(samples), 1,
          "of no joint of these drawings it is known whether it is right; there is nothing to learn");
}

}  // namespace
}  // namespace skel
