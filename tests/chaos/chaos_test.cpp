// Every tool, while what it asks of the system fails: each call that changes files in turn, each large
// allocation, a signal before each call, death at each call. What it was to write over is whole afterwards,
// the old or the new; nothing else has changed; it says one line and gives the right code. script/chaos runs
// the long way, with a thousand deaths.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <vector>

#include "libskel/skeleton/motion_file.h"
#include "tests/tools/tools.h"

using namespace skel;

namespace {

namespace fs = std::filesystem;

// What a tool does, over what it has written before.
struct Job {
  std::string name, command;
  void (*prepare)(const TempDir& dir);  // inputs
  void (*change)(const TempDir& dir);   // so that the outputs become others
  bool slow = false;                    // seconds a run: for script/chaos alone, with few of its allocations
};

const std::string kFilm = "skel-animate render a.glb --clip wave --size 48x48 --fps 8 --duration 0.3 -o ",
                  kTrain =
                      "skel-train joints --batch 4 --figures 64 --validation 4 --threads 1 "
                      "--report-every 3 -o n.bin --checkpoint state ";

void writeJoints(const std::string& path, double swing) {
  const auto at = [](double x, double y) { return "[" + std::to_string(x) + ", " + std::to_string(y) + "]"; };
  writeFile(path, "{\"view\": \"front\", \"style\": \"flat\", \"joints\": {\"head\": " + at(80, 40) +
                      ", \"body\": " + at(80, 92) + ", \"right_shoulder\": " + at(66, 80) +
                      ", \"right_elbow\": " + at(48, 95 + swing / 2) +
                      ", \"right_hand\": " + at(32, 108 + swing) + ", \"left_shoulder\": " + at(94, 80) +
                      ", \"left_elbow\": " + at(112, 95 - swing / 2) +
                      ", \"left_hand\": " + at(128, 108 - swing) + ", \"right_hip\": " + at(72, 120) +
                      ", \"right_knee\": " + at(66, 150) + ", \"right_foot\": " + at(61 + swing, 182) +
                      ", \"left_hip\": " + at(88, 120) + ", \"left_knee\": " + at(94, 150) +
                      ", \"left_foot\": " + at(99 - swing, 182) + "}}\n");
}

void writeLabelled(const TempDir& dir, double swing) {
  writeFigure(dir.file("set/a.png"), swing);
  writeJoints(dir.file("set/a.joints.json"), swing);
  done(dir, "skel-label import set --force");
}

void writeCharacter(const TempDir& dir, double swing) {
  writeFigure(dir.file("a.png"), swing);
  done(dir, "skel-infer a.png -o . --formats glb --clips wave --force");
}

// A net that has made some steps of three.
void trainSteps(const TempDir& dir, int steps) {
  done(dir, "rm -f state && " + kTrain + "--steps " + std::to_string(steps));
}

void writeMotion(const TempDir& dir, const std::string& place) {
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion = readMotionFile(SKEL_SOURCE_DIR "/tests/data/formats/skel-motion-2.json", plan);
  for (MotionFrame& frame : motion.frames)
    for (std::optional<PlacedJoint>& joint : frame.joints)
      if (!joint) joint = PlacedJoint{.image = {40, 50}, .confidence = 1};
  std::string text = formatMotionFile(motion, plan);
  text.replace(text.find("61.25"), 5, place);
  writeFile(dir.file("walk.motion.json"), text);
}

const std::vector<Job>& jobs() {
  static const auto character = [](const TempDir& dir) { writeCharacter(dir, 0); };
  static const auto otherCharacter = [](const TempDir& dir) { writeCharacter(dir, 12); };
  static const std::vector<Job> all = {
      {"skel-infer",
       "skel-infer a.png -o out --formats glb,json,overlay,silhouette,obj,weights,features --force",
       [](const TempDir& dir) { writeFigure(dir.file("a.png")); },
       [](const TempDir& dir) { writeFigure(dir.file("a.png"), 12); }},
      {"skel-label", "skel-label import set --force",
       [](const TempDir& dir) {
         writeFigure(dir.file("set/a.png"));
         writeJoints(dir.file("set/a.joints.json"), 0);
       },
       [](const TempDir& dir) { writeJoints(dir.file("set/a.joints.json"), 12); }},
      {"skel-train", "skel-train set -o w.json --folds 0 --generated 0 --warps 0 --restarts 1 --epochs 3",
       [](const TempDir& dir) { writeLabelled(dir, 0); }, [](const TempDir& dir) { writeLabelled(dir, 12); }},
      {"skel-animate", kFilm + "film.gif", character, otherCharacter},
      {"frames of skel-animate", kFilm + "frames/", character, otherCharacter},
#ifdef SKEL_VIDEO_MP4
      {"an MP4 of skel-animate", kFilm + "film.mp4", character, otherCharacter},
#endif
#ifdef SKEL_VIDEO_WEBP
      {"a WebP of skel-animate", kFilm + "film.webp", character, otherCharacter},
#endif
      {"a sheet of skel-animate",
       "skel-animate render a.glb --clip wave --sheet sheet.png --frames 2 --size 32", character,
       otherCharacter},
      {"skel-animate bind", "skel-animate bind a.glb -o bound.glb", character, otherCharacter},
      {"skel-animate retarget", "skel-animate retarget wave --to a.glb -o waves.glb", character,
       otherCharacter},
      {"skel-label export", "skel-label export set --coco -o set.coco.json",
       [](const TempDir& dir) { writeLabelled(dir, 0); }, [](const TempDir& dir) { writeLabelled(dir, 12); }},
      {"skel-style", "skel-style database add db walk.motion.json --action walk --force",
       [](const TempDir& dir) { writeMotion(dir, "61.25"); },
       [](const TempDir& dir) { writeMotion(dir, "60.75"); }},
      {"a report of skel-infer", "skel-infer a.png -o out --formats json --report report.html --force",
       [](const TempDir& dir) { writeFigure(dir.file("a.png")); },
       [](const TempDir& dir) { writeFigure(dir.file("a.png"), 12); }, true},
      {"skel-infer that goes on", "skel-infer a.png b.png -o out --formats json --resume --quiet",
       [](const TempDir& dir) { writeFigure(dir.file("a.png")), writeFigure(dir.file("b.png"), 6); },
       [](const TempDir& dir) { writeFigure(dir.file("a.png"), 12); }, true},
      {"skel-style make",
       "skel-style make --character a.png --content walk.motion.json --style walk.motion.json -o made.gif "
       "--size 48 --rate 4 --duration 0.5 --force",
       [](const TempDir& dir) { writeFigure(dir.file("a.png")), writeMotion(dir, "61.25"); },
       [](const TempDir& dir) { writeFigure(dir.file("a.png"), 12), writeMotion(dir, "60.75"); }, true},
      {"skel-train joints", kTrain + "--steps 3", [](const TempDir& dir) { trainSteps(dir, 1); },
       [](const TempDir& dir) { trainSteps(dir, 2); }, true},
  };
  return all;
}

// All files below a folder, by their paths from there; without how long it took, which results tell.
using Files = std::map<std::string, std::string>;
Files filesOf(const TempDir& dir) {
  static const std::regex times("\"times_ms\":\\{[^}]*\\}");
  Files files;
  for (const std::string& path : filesBelow(dir.path())) {
    std::string& bytes = files[fs::relative(path, dir.path())] = readFile(path);
    if (path.ends_with(".result.json")) bytes = std::regex_replace(bytes, times, "\"times_ms\":{}");
  }
  return files;
}

void copyInto(const Files& files, const TempDir& dir) {
  for (const auto& [path, bytes] : files) {
    fs::create_directories(fs::path(dir.file(path)).parent_path());
    writeFile(dir.file(path), bytes);
  }
}

// A job before it is disturbed, and after it was not.
class Stage {
 public:
  explicit Stage(const Job& job) : job_(job) {
    const TempDir dir;
    job.prepare(dir);
    done(dir, job.command);
    job.change(dir);
    before_ = filesOf(dir);
    done(dir, job.command);
    after_ = filesOf(dir);
    CHECK(before_ != after_);
  }

  // How many calls, or allocations, there are to be spoiled.
  long count(const std::string& plan) const {
    const TempDir dir, other;
    copyInto(before_, dir);
    const ToolRun run =
        runIn(dir, "export SKEL_CHAOS='" + plan + "' SKEL_CHAOS_COUNT='" + other.file("count") +
                       "' && LD_PRELOAD='" SKEL_CHAOS_LAYER "' " + job_.command);
    REQUIRE(run.exit_code == 0);
    return std::stol(readFile(other.file("count")));
  }

  // `codes`: what it may say; 0 is always one of them, where the spoiled call did not matter.
  void disturb(const std::string& plan, const std::vector<int>& codes) const {
    const bool killed = plan.starts_with("kill");
    const TempDir dir;
    copyInto(before_, dir);
    const ToolRun run = runIn(
        dir, "export SKEL_CHAOS='" + plan + "' && LD_PRELOAD='" SKEL_CHAOS_LAYER "' exec " + job_.command);
    INFO(job_.name << ", " << plan << ": code " << run.exit_code << "\n" << run.err);
    CHECK((run.exit_code == 0 || std::count(codes.begin(), codes.end(), run.exit_code)));
    Files now = filesOf(dir);
    std::erase_if(now, [&](const auto& file) {
      const bool temporary = file.first.ends_with(".skel-tmp");
      if (temporary && !killed) FAIL_CHECK(file.first << " is left");
      return temporary;
    });
    if (run.exit_code == 0) {
      CHECK(now == after_);
      return;
    }
    // A full disk keeps from a page of reports what it has kept from the results.
    const bool both = plan.starts_with("full") && job_.command.find("--report") != std::string::npos;
    const long lines = complaints(run.err);
    if (run.exit_code < 128) CHECK((lines == 1 || (both && lines == 2)));
    for (const auto& [path, bytes] : now) {
      const auto old = before_.find(path), fresh = after_.find(path);
      if (tellsOfFailure(path, bytes)) continue;
      if (!(old != before_.end() && old->second == bytes) &&
          !(fresh != after_.end() && fresh->second == bytes))
        FAIL_CHECK(path << " is neither the old file nor the new one");
    }
    for (const auto& [path, bytes] : before_)
      if (!now.contains(path)) FAIL_CHECK(path << " is lost");
    if (!killed) return;
    // Who comes next takes over what was left.
    done(dir, job_.command);
    CHECK(filesOf(dir) == after_);
  }

 private:
  // What is written about a drawing that failed, too: whole, but neither of before nor of after.
  static bool tellsOfFailure(const std::string& path, const std::string& bytes) {
    if (path.ends_with(".result.json")) return bytes.starts_with("{") && bytes.ends_with("}\n");
    return path == "report.html" && bytes.starts_with("<!") && bytes.ends_with("</html>\n");
  }

  // Lines that are no notes. x264 has its own say, which nothing keeps from it.
  static long complaints(const std::string& err) {
    std::istringstream lines(err);
    long count = 0;
    for (std::string line; std::getline(lines, line);)
      count += line.find("note: ") == std::string::npos && !line.starts_with("x264 [error]: malloc") &&
               !line.empty();
    return count;
  }

  Job job_;
  Files before_, after_;
};

constexpr int kOutput = 4, kUnavailable = 3;
constexpr long kLargeBytes = 65536;

// `every`: so many-th of the large allocations is refused, of slow jobs some dozens in all.
void disturbAll(const Job& job, long every) {
  const Stage stage(job);
  const long calls = stage.count("fail 0");
  CHECK(calls >= 4);
  for (long n = 1; n <= calls; ++n) {
    const std::string at = std::to_string(n);
    stage.disturb("fail " + at, {kOutput});
    stage.disturb("full " + at, {kOutput});
    stage.disturb("signal " + at + " " + std::to_string(n % 2 ? SIGTERM : SIGINT),
                  {128 + (n % 2 ? SIGTERM : SIGINT)});
    stage.disturb("kill " + at + " 8", {128 + SIGKILL});
  }
  const std::string size = std::to_string(kLargeBytes);
  const long allocations = stage.count("alloc 0 " + size);
  constexpr long kFew = 32;
  if (job.slow) every = std::max(every, allocations / kFew);
  for (long n = 1; n <= allocations; n += every)
    stage.disturb("alloc " + std::to_string(n) + " " + size, {kUnavailable, kOutput});
  std::printf("%s: %ld calls, %ld large allocations\n", job.name.c_str(), calls, allocations);
}

}  // namespace

// Every so many-th of the large allocations: script/chaos refuses them all.
constexpr long kSome = 4;

TEST_CASE("Each call of skel-infer that changes files fails, is interrupted or is the last one") {
  disturbAll(jobs().front(), kSome);
}

TEST_CASE("Each call of the other tools that changes files fails, is interrupted or is the last one") {
  for (const Job& job : jobs()) {
    if (job.slow || &job == &jobs().front()) continue;
    DYNAMIC_SECTION(job.name) { disturbAll(job, kSome); }
  }
}

TEST_CASE("Every large allocation fails once", "[.whole]") {
  for (const Job& job : jobs()) {
    DYNAMIC_SECTION(job.name) { disturbAll(job, 1); }
  }
}

TEST_CASE("A thousand deaths while saving", "[.whole]") {
  int deaths = 0;
  std::vector<Stage> stages;
  for (const Job& job : jobs()) stages.emplace_back(job);
  for (int part = 0; deaths < 1000; part = (part + 3) % 17)
    for (const Stage& stage : stages) {
      const long calls = stage.count("fail 0");
      for (long n = 1; n <= calls; ++n, ++deaths)
        stage.disturb("kill " + std::to_string(n) + " " + std::to_string(part), {128 + SIGKILL});
    }
  std::printf("killed %d times\n", deaths);
}
