#include "libskel/skeleton/motion_file.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

const SkeletonTemplate& biped() {
  static const SkeletonTemplate plan = loadTemplate("biped");
  return plan;
}

MotionFile example() {
  MotionFile motion;
  motion.frame_rate = 12.5;
  for (int f = 0; f < 3; ++f) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.image_file = "frames/h\xe9ros " + std::to_string(f) + ".png";
    frame.image_width = 200;
    frame.image_height = 300;
    frame.time_s = f / 12.5;
    frame.joints.resize(biped().joints.size());
    frame.joints[1] = PlacedJoint{{10.25, 20.5 + f}, 0.75, JointOrigin::kRecognized};
    if (f != 1) frame.joints[4] = PlacedJoint{{0, 299}, 1, JointOrigin::kEdited};
  }
  motion.frames[1].joints[1].reset();
  return motion;
}

// The complaint about the example after `what` was replaced by `with`.
std::string complaint(const std::string& what, const std::string& with) {
  const TempDir dir;
  std::string text = formatMotionFile(example(), biped());
  const size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  text.replace(at, what.size(), with);
  writeFile(dir.file("m.motion.json"), text);
  try {
    readMotionFile(dir.file("m.motion.json"), biped());
  } catch (const InputError& error) {
    CHECK(error.file() == dir.file("m.motion.json"));
    return error.problem();
  }
  return "none";
}

}  // namespace

TEST_CASE("a motion file comes back as it was written") {
  const TempDir dir;
  const std::string path = dir.file("m.motion.json"), text = formatMotionFile(example(), biped());
  writeFile(path, text);
  const MotionFile again = readMotionFile(path, biped());
  CHECK(formatMotionFile(again, biped()) == text);
  CHECK(again.frame_rate == 12.5);
  REQUIRE(again.frames.size() == 3);
  for (size_t f = 0; f < 3; ++f) {
    const MotionFrame &frame = again.frames[f], before = example().frames[f];
    CHECK(frame.image_file == before.image_file);
    CHECK(frame.image_width == 200);
    CHECK(frame.image_height == 300);
    CHECK(frame.time_s == before.time_s);
    CHECK(frame.joints == before.joints);
  }
}

TEST_CASE("a motion file keeps its source, its action and its key frames") {
  const TempDir dir;
  const std::string path = dir.file("m.motion.json");
  MotionFile motion = example();
  CHECK(formatMotionFile(motion, biped()).find("\"version\": 1") != std::string::npos);
  motion.source = "h\xe9ros.mp4";
  motion.action = "walk";
  motion.frames[1].key = true;
  motion.frames[2].image_file = "";
  const std::string text = formatMotionFile(motion, biped());
  CHECK(text.find("\"version\": 2") != std::string::npos);
  writeFile(path, text);
  const MotionFile again = readMotionFile(path, biped());
  CHECK(formatMotionFile(again, biped()) == text);
  CHECK(again.source == motion.source);
  CHECK(again.action == "walk");
  CHECK_FALSE(again.frames[0].key);
  CHECK(again.frames[1].key);
  CHECK(again.frames[2].image_file.empty());
}

TEST_CASE("a motion file with a mistake is refused with its place") {
  CHECK(complaint("skel-motion", "skel-skeleton") ==
        "is a file of format \"skel-skeleton\", \"skel-motion\" was expected");
  CHECK(complaint("\"version\": 1", "\"version\": 3") ==
        "version: is 3, this program reads up to 2; use a newer skel");
  CHECK(complaint("\"biped\"", "\"quadruped\"") ==
        "template: is \"quadruped\", but the template in use is \"biped\"; give the same --template");
  CHECK(complaint("12.5", "0") == "frame_rate: is 0, must be between 0.001 and 1000");
  CHECK(complaint("\"frame_rate\"", "\"fps\"") == "has the unknown key \"fps\"");
  CHECK(complaint("\"width\":200", "\"width\":0") ==
        "frames[0].image.width: is 0, must be a whole number between 1 and 1000000");
  CHECK(complaint("\"time_s\": 0.16", "\"time_s\": 0.08") ==
        "frames[2].time_s: must be later than that of the frame before");
  CHECK(complaint("\"time_s\": 0.0", "\"time_s\": -1.0") ==
        "frames[0].time_s: is -1, must be between 0 and 1000000");
  CHECK(complaint("\"body\"", "\"wing\"") ==
        "frames[0].joints[0].name: \"wing\" is no joint of the template \"biped\"");
  CHECK(complaint("\"body\"", "\"" + biped().joints[4].name + "\"") ==
        "frames[0].joints[1].name: joint \"" + biped().joints[4].name + "\" stands here for the second time");
  CHECK(complaint("10.25", "200.25") ==
        "frames[0].joints[0].image: joint \"body\" lies outside the image of 200x300 px");
  CHECK(complaint("0.75", "1.75") == "frames[0].joints[0].confidence: is 1.75, must be between 0 and 1");
  CHECK(complaint("\"recognized\"", "\"guessed\"") ==
        "frames[0].joints[0].origin: is \"guessed\", must be recognized, completed, derived or edited");
}

TEST_CASE("a motion without frames is refused") {
  const TempDir dir;
  MotionFile motion = example();
  motion.frames.clear();
  writeFile(dir.file("m"), formatMotionFile(motion, biped()));
  CHECK_THROWS_WITH(readMotionFile(dir.file("m"), biped()), dir.file("m") + ": frames: is empty");
}

// Room for each joint of each frame: gigabytes of a small file.
TEST_CASE("a motion of more frames than a template of many joints bears is refused") {
  const TempDir dir;
  SkeletonTemplate plan = biped();
  plan.joints.resize(1000);
  std::string text = R"({"format": "skel-motion", "version": 1, "template": ")" + plan.name +
                     R"(", "frame_rate": 10, "frames": [)";
  for (int f = 0; f < 10'001; ++f) text += f ? ",0" : "0";
  writeFile(dir.file("m.motion.json"), text + "]}");
  CHECK_THROWS_WITH(readMotionFile(dir.file("m.motion.json"), plan),
                    Catch::Matchers::Contains("frames: are 10001, each with 1000 joints"));
}
