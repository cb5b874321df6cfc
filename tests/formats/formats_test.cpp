// Files of every version of every format of our own, tests/data/formats: <format>-<version>.json (.csv, .bin
// ...). 0 is the version of files that carry none. They stay there for ever, and are read. Nets are in
// weights/archive.
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "animator/pose_file.h"
#include "animator/sprite_atlas.h"
#include "infer/result_file.h"
#include "labeler/annotated_drawing.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/keyframe_clip.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_character.h"
#include "libskel/import/read_weights.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/labels/label_file.h"
#include "libskel/layers/limb_net.h"
#include "libskel/layers/part_net.h"
#include "libskel/recognition/confidence_model.h"
#include "libskel/recognition/facing_net.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/silhouette/loops.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/rig_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skeleton/template.h"
#include "libskel/skin/regions.h"
#include "stylizer/database.h"
#include "stylizer/style_file.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"
#include "tests/support/temp_dir.h"
#include "tests/support/tiny_net.h"
#include "trainer/confidence_table.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/hands.h"
#include "trainer/made_by.h"

using namespace skel;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kFolder = SKEL_SOURCE_DIR "/tests/data/formats/",
                  kArchive = SKEL_SOURCE_DIR "/weights/archive/";

// Reads a file and gives what our writer makes of it, "" where nothing writes the format.
using Reader = std::function<std::string(const std::string& path)>;

std::string readDatabaseIndex(const std::string& path) {
  const TempDir dir;
  const std::string motion = dir.file("walk.motion.json"), database = dir.file("database");
  writeFile(database + "/" + kDatabaseIndex, readFile(path));
  writeFile(motion, readFile(kFolder + "skel-motion-2.json"));
  readDatabase(database);
  addToDatabase(database, motion, "", true);
  return readFile(database + "/" + kDatabaseIndex);
}

std::string readJoints(const std::string& path) {
  const TempDir dir;
  writeFile(dir.file("a.joints.json"), readFile(path));
  writeFile(dir.file("a.png"), "");
  const auto drawings = findAnnotatedDrawings(dir.path(), {loadTemplate("biped")});
  REQUIRE(drawings.size() == 1);
  CHECK(drawings[0].joints.size() == 14);
  return "";
}

std::string readCheckpoint(const std::string& path) {
  ConvNetTrainer trainer(tinyNet(), {.steps = 8});
  trainer.restore(readFile(path), path);
  CHECK(trainer.steps() == 3);
  return trainer.checkpoint();
}

const std::map<std::string, Reader>& readers() {
  static const SkeletonTemplate biped = loadTemplate("biped");
  static const auto character = [] { return readGlb(kFolder + "character-0.glb").character; };
  static const std::map<std::string, Reader> all = {
      {"character",
       [](const std::string& path) {
         const CharacterFile file = readGlb(path);
         ExportOptions options;
         options.name = file.name;
         decodeGlb(encodeGlb(file.character, file.clips, options), path);
         return "";
       }},
      {"coco",
       [](const std::string& path) {
         const TempDir dir;
         writeFile(dir.file("coco.json"), readFile(path));
         writeFile(dir.file("a.png"), "");
         const std::vector<AnnotatedDrawing> drawings = readCoco(dir.file("coco.json"), {biped});
         REQUIRE(drawings.size() == 1);
         CHECK(drawings[0].joints.size() == 3);
         CHECK(drawings[0].recognized == std::vector<std::string>{"right_hand"});
         return "";
       }},
      {"hands",
       [](const std::string& path) {
         const Hands hands = readHands(path, "comic clip art");
         CHECK(hands.of("dog") == "children of 3 to 13");
         CHECK(hands.learned == std::set<std::string>{"cat", "dog"});
         return "";
       }},
      {"joints", readJoints},
      {"key-frames",
       [](const std::string& path) {
         const auto file = readKeyframeClip(path, figureSkeleton());
         CHECK(file.duration_s() == 3);
         return "";
       }},
      {"model-skeleton",
       [](const std::string& path) {
         CHECK(readRigFile(path).joints.size() >= 4);
         return "";
       }},
      {"skel-checkpoint", readCheckpoint},
      {"skel-clip", [](const std::string& path) { return formatClip(readClipFile(path)); }},
      {"skel-confidence",
       [](const std::string& path) {
         return formatConfidenceModel(parseConfidenceModel(readFile(path), path));
       }},
      {"skel-confidence-table",
       [](const std::string& path) {
         return formatConfidenceTable(parseConfidenceTable(readFile(path), path));
       }},
      {"skel-joint-net",
       [](const std::string& path) { return formatJointNet(parseJointNet(readFile(path), path)); }},
      {"skel-labels", [](const std::string& path) { return formatLabelFile(readLabelFile(path)); }},
      {"skel-motion",
       [](const std::string& path) { return formatMotionFile(readMotionFile(path, biped), biped); }},
      {"skel-motions", readDatabaseIndex},
      {"skel-page-net",
       [](const std::string& path) { return formatPageNet(parsePageNet(readFile(path), path)); }},
      {"skel-part-net",
       [](const std::string& path) { return formatPartNet(parsePartNet(readFile(path), path)); }},
      {"skel-pose",
       [](const std::string& path) {
         const Skeleton skeleton = figureSkeleton();
         return formatPose(parsePose(readFile(path), path, skeleton), skeleton);
       }},
      {"skel-facing-net",
       [](const std::string& path) { return formatFacingNet(parseFacingNet(readFile(path), path)); }},
      {"skel-limb-net",
       [](const std::string& path) { return formatLimbNet(parseLimbNet(readFile(path), path)); }},
      {"skel-loop-net",
       [](const std::string& path) { return formatLoopNet(parseLoopNet(readFile(path), path)); }},
      {"skel-regions",
       [](const std::string& path) {
         const auto file = readRegions(path);
         CHECK(file.regions.size() == 3);
         return "";
       }},
      {"skel-result",
       [](const std::string& path) { return formatResult(parseResult(readFile(path), path), path); }},
      {"skel-silhouette-confidence",
       [](const std::string& path) {
         return formatSilhouetteConfidence(parseSilhouetteConfidence(readFile(path), path));
       }},
      {"skel-skeleton",
       [](const std::string& path) { return formatSkeletonFile(readSkeletonFile(path, biped)); }},
      {"skel-skin",
       [](const std::string& path) {
         RiggedCharacter bound = character();
         bound.weights = readWeights(path, bound);
         return exportWeights({bound, {}, {}}).at(0).bytes;
       }},
      {"skel-style", [](const std::string& path) { return formatStyleFile(readStyleFile(path)); }},
      {"skel-template",
       [](const std::string& path) {
         const auto file = parseTemplate(readFile(path), path);
         CHECK(file.joints.size() == biped.joints.size());
         return "";
       }},
      {"skel-training",
       [](const std::string& path) {
         const auto made_by = parseMadeBy(readFile(path), path);
         REQUIRE(made_by);
         return formatMadeBy(*made_by);
       }},
      {"sprite-atlas",
       [](const std::string& path) {
         const SpriteCell cell = readSpriteCell(path);
         CHECK(cell.width == 48);
         CHECK(cell.pivot_y == 37);
         CHECK(cell.px_per_m == 20.5);
         CHECK(cell.pitch_deg == 20);
         return "";
       }},
      {"skel-weights", [](const std::string& path) { return formatWeights(readWeights(path)); }},
  };
  return all;
}

// What a text is, by its own words.
struct Header {
  std::string format;
  int version = 0;
};
Header headerOf(const std::string& text) {
  static const std::regex table("(skel-[a-z-]+),([0-9]+)\n");
  std::smatch parts;
  if (std::regex_search(text, parts, table, std::regex_constants::match_continuous))
    return {parts[1], std::stoi(parts[2])};
  // Of a net and a checkpoint, the first line.
  Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded()) root = Json::parse(text.substr(0, text.find('\n')), nullptr, false);
  if (!root.is_object() || !root.contains("format")) return {};
  return {root["format"], root["version"]};
}

// The same file, of a version that there will never be.
std::string ofNewVersion(std::string text) {
  const std::string table = headerOf(text).format + ",", json = "\"version\":";
  const bool is_table = text.starts_with(table);
  const std::size_t at = is_table ? table.size() : text.find(json) + json.size();
  return text.replace(at, text.find_first_of(is_table ? "\n" : ",}", at) - at, "1000000");
}

struct Sample {
  std::string path, format;
  int version = 0;
};

// All there are.
const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> found;
    const std::regex name("(.+)-([0-9]+)\\.(json|csv|bin|glb)");
    for (const auto& entry : fs::directory_iterator(kFolder)) {
      std::smatch parts;
      const std::string file = entry.path().filename();
      INFO(entry.path() << ": files of this folder are called <format>-<version>.json");
      REQUIRE(std::regex_match(file, parts, name));
      // The one format that scripts alone read: tests/others.
      if (parts[1] == "skel-others-drawing") continue;
      found.push_back({entry.path(), parts[1], std::stoi(parts[2])});
    }
    for (const auto& entry : fs::directory_iterator(kArchive)) {
      if (entry.path().extension() != ".bin") continue;
      const Header header = headerOf(readFile(entry.path()));
      found.push_back({entry.path(), header.format, header.version});
    }
    return found;
  }();
  return all;
}

bool hasSample(const std::string& format, int version) {
  for (const Sample& sample : samples())
    if (sample.format == format && sample.version == version) return true;
  return false;
}

std::string whatToAdd(const std::string& format, int version) {
  const std::string file = format + "-" + std::to_string(version);
  if (format.ends_with("-net"))
    return "weights/archive has no " + format + " of version " + std::to_string(version) +
           ": put a copy of one there that this program has written, and leave it there for ever";
  return "tests/data/formats has no " + file + ".json: put a small file there that has all that version " +
         std::to_string(version) + " of " + format +
         " can hold, as this program writes it, and leave it there for ever";
}

std::string complaintAbout(const Reader& read, const std::string& path) {
  try {
    read(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("A file of every version of every own format is read, and written again with all that is in it") {
  for (const Sample& sample : samples()) {
    INFO(sample.path);
    const auto reader = readers().find(sample.format);
    if (reader == readers().end())
      FAIL("nothing in this test reads \"" << sample.format << "\": add its reader");
    const std::string bytes = readFile(sample.path);
    const bool is_glb = sample.path.ends_with(".glb");
    if (!is_glb) CHECK(headerOf(bytes).version == sample.version);
    if (!is_glb && sample.version > 0) CHECK(headerOf(bytes).format == sample.format);
    std::string written;
    REQUIRE_NOTHROW(written = reader->second(sample.path));
    if (written.empty()) continue;
    const Header header = headerOf(written);
    CHECK(header.format == sample.format);
    if (!hasSample(header.format, header.version)) FAIL(whatToAdd(header.format, header.version));
    if (header.version != sample.version || sample.format.ends_with("-net")) continue;
    if (sample.path.ends_with(".json"))
      CHECK(Json::parse(written) == Json::parse(bytes));
    else
      CHECK(written == bytes);
  }
}

TEST_CASE("There is a file of each version that a reader says it reads") {
  for (const auto& [format, read] : readers()) {
    const auto sample = std::find_if(samples().begin(), samples().end(), [&, name = format](const Sample& s) {
      return s.format == name && s.version > 0;
    });
    if (sample == samples().end()) {
      if (!hasSample(format, 0)) FAIL(whatToAdd(format, 1));
      continue;
    }
    // The reader tells its newest version when it refuses a newer one.
    const TempDir dir;
    writeFile(dir.file("new"), ofNewVersion(readFile(sample->path)));
    const std::string complaint = complaintAbout(read, dir.file("new"));
    std::smatch newest;
    INFO(complaint);
    REQUIRE(std::regex_search(complaint, newest, std::regex("this program reads up to ([0-9]+);")));
    for (int version = 1; version <= std::stoi(newest[1]); ++version)
      if (!hasSample(format, version)) FAIL(whatToAdd(format, version));
  }
}

TEST_CASE("No format is made without a file that keeps it") {
  // Tools, and files that are for other programs: nothing of ours reads them.
  const std::set<std::string> others = {"skel-infer",   "skel-train",     "skel-label",
                                        "skel-animate", "skel-keyframes", "skel-distances"};
  const std::regex literal("\"(skel-[a-z-]+[a-z])\"");
  for (const char* folder : {"libskel", "infer", "labeler", "trainer", "animator", "stylizer", "web"}) {
    for (const std::string& file : filesBelow(std::string(SKEL_SOURCE_DIR "/") + folder)) {
      if (!file.ends_with(".cpp")) continue;
      const std::string text = readFile(file);
      for (std::sregex_iterator match(text.begin(), text.end(), literal), end; match != end; ++match) {
        const std::string name = (*match)[1];
        INFO("\"" << name << "\" in " << file << " looks like a format that tests/formats does not know: "
                  << whatToAdd(name, 1) << ", and its reader to readers()");
        CHECK((others.contains(name) || readers().contains(name)));
      }
    }
  }
}
