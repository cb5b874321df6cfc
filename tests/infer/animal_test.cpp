// skel-infer --template quadruped as a user runs it.
#include <algorithm>

#include "infer/annotation.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/skeleton/skeleton_file.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

const std::string kAnimals = SKEL_SOURCE_DIR "/datasets/animals";

bool contains(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

ToolRun infer(const std::string& arguments) { return runTool("skel-infer " + arguments); }

}  // namespace

TEST_CASE("a child's pig is rigged as a quadruped, with a motion of its own") {
  const TempDir dir;
  const ToolRun run = infer("'" + kAnimals + "/crayon_pig.png' --template quadruped -o '" + dir.path() + "'");
  CAPTURE(run.err);
  REQUIRE(run.exit_code == 0);
  const SkeletonTemplate body_plan = loadTemplate("quadruped");
  const SkeletonFile file = readSkeletonFile(dir.file("crayon_pig.skeleton.json"), body_plan);
  CHECK(file.confidence >= 0.5);
  const MeasuredDrawing truth = readMeasuredDrawing(kAnimals, "crayon_pig");
  Recognition recognition;
  recognition.skeleton = file.skeleton;
  CHECK(score(truth, &recognition, *truth.mask, body_plan).pck10 >= 0.9);
  CHECK(readFile(dir.file("crayon_pig.glb")).find("\"wag\"") != std::string::npos);
}

TEST_CASE("the body plan is the one that the figure fits, unless one is named") {
  const TempDir dir;
  const std::string both = "'" + kAnimals + "/walking_dog.png' '" + kAnimals +
                           "/../characters/cap_boy.png' --clips idle,gallop,none -o '" + dir.path() + "'";
  CHECK(infer(both).exit_code == 1);  // "none" is no clip
  const ToolRun run = infer("'" + kAnimals + "/walking_dog.png' '" + kAnimals +
                            "/../characters/cap_boy.png' --clips wave,gallop -o '" + dir.path() + "'");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.out, "walking_dog.glb  confidence 0.9"));
  CHECK(contains(run.out, "  quadruped, looking left\n"));
  CHECK(contains(run.out, "  biped\n"));
  CHECK(contains(run.err, "note: there is no clip \"wave\" for a quadruped: left out: "));
  CHECK(contains(run.err, "note: there is no clip \"gallop\" for a biped, but \"run\": left out: "));
  CHECK(readSkeletonFile(dir.file("walking_dog.skeleton.json"), loadTemplate("quadruped")).confidence > .8);

  // What was found is gone on from, whatever the plan.
  const ToolRun again = infer("'" + kAnimals + "/walking_dog.png' --skeleton '" +
                              dir.file("walking_dog.skeleton.json") + "' -o '" + dir.file("again") + "'");
  CHECK(again.exit_code == 0);
  CHECK(contains(again.out, "  quadruped, looking left\n"));
  CHECK(readFile(dir.file("again/walking_dog.glb")).find("\"gallop\"") != std::string::npos);

  const ToolRun named =
      infer("'" + kAnimals + "/walking_dog.png' --template biped -o '" + dir.file("named") + "'");
  CHECK(named.exit_code == 0);
  CHECK(contains(named.err, "it looks like a quadruped: try --template quadruped"));
  CHECK(!contains(named.out, "biped"));
}

TEST_CASE("a joint net can be given as a file") {
  const TempDir dir;
  const std::string base = "'" + kAnimals + "/crayon_pig.png' --template quadruped --formats json -o '" +
                           dir.path() + "' --joint-net '" SKEL_SOURCE_DIR "/weights/";
  CHECK(infer(base + "quadruped_joint_net.bin'").exit_code == 0);
  const ToolRun other = infer(base + "joint_net.bin'");
  CHECK(other.exit_code == 1);
  CHECK(contains(other.err,
                 "/weights/joint_net.bin is a net of the template \"biped\", joints of the template "
                 "\"quadruped\" are looked for; name the template by --template biped, or another net"));
}

TEST_CASE("a part net can be given as a file, and no other net in its place") {
  const TempDir dir;
  const std::string base = "'" + kAnimals + "/crayon_pig.png' --template quadruped --formats layers -o '" +
                           dir.path() + "' --part-net '" SKEL_SOURCE_DIR "/weights/";
  CHECK(infer(base + "part_net.bin'").exit_code == 0);
  const ToolRun other = infer(base + "joint_net.bin' --force");
  CHECK(other.exit_code == 2);
  CHECK(other.err.find("joint_net.bin: is a net that finds joints (--joint-net); a net that tells parts "
                       "(--part-net) was expected") != std::string::npos);
}

TEST_CASE("a checkpoint that was given as a net was said to be no JSON") {
  const std::string formats = SKEL_SOURCE_DIR "/tests/data/formats/";
  const TempDir dir;
  const std::string checkpoint = dir.file("net.checkpoint");
  writeFile(checkpoint,
            readFile(formats + "skel-training-1.json") + readFile(formats + "skel-checkpoint-1.bin"));
  for (const char* option : {"--weights", "--joint-net", "--part-net"}) {
    const ToolRun run = infer("'" + kAnimals + "/crayon_pig.png' -o '" + dir.path() + "' " + option + " '" +
                              checkpoint + "'");
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("net.checkpoint: is a checkpoint (the line of skel-train that wrote it, run to "
                       "its end, makes a net of it); ") != std::string::npos);
  }
}

// Also: drawings side by side in a folder are evaluated like those in folders of their own.
TEST_CASE("the drawn animals are found, from the picture alone") {
  const TempDir dir;
  const ToolRun run =
      infer("evaluate '" + kAnimals + "' --template quadruped --json '" + dir.file("a.json") + "'");
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("mean over 14 characters") != std::string::npos);
  const JsonDocument document = JsonDocument::readFile(dir.file("a.json"));
  const JsonValue characters = document.root().at("characters");
  CHECK(characters.keys().size() == 14);
  // Who is sure is right, but for a sitting cat, whose hind legs are hidden in its silhouette.
  int sure = 0, wrong = 0;
  for (const std::string& name : characters.keys()) {
    const JsonValue animal = characters.at(name);
    if (animal.at("confidence").asNumber() < 0.5) continue;
    ++sure;
    wrong += animal.at("pck10").asNumber() < 0.85;
  }
  CHECK(sure >= 12);
  CHECK(wrong <= 1);
  const JsonValue mean = document.root().at("mean");
  CHECK(mean.at("pck05").asNumber() >= 0.82);
  CHECK(mean.at("pck10").asNumber() >= 0.94);
  CHECK(mean.at("usable").asNumber() >= 0.78);
}

TEST_CASE("the joints of an animal keep their names where others are asked for, and a note says so") {
  const TempDir dir;
  const ToolRun run =
      infer("'" + kAnimals + "/crayon_pig.png' --names mixamo --formats glb -o '" + dir.path() + "'");
  CHECK(run.exit_code == 0);
  CHECK(contains(run.err, "note: the joints keep their names: --names mixamo is for bipeds"));
  CHECK_FALSE(contains(readFile(dir.file("crayon_pig.glb")), "mixamorig"));
}

TEST_CASE("a net of joints that was not used, as the drawing shows an animal, was not said") {
  const TempDir dir;
  const std::string net = " --formats json --joint-net '" SKEL_SOURCE_DIR "/weights/joint_net.bin' -o '" +
                          dir.path() + "'",
                    said =
                        "note: the joints of this quadruped come from the net that is built in: the one of "
                        "--joint-net finds those of a biped";
  CHECK(contains(infer("'" + kAnimals + "/walking_dog.png'" + net).err, said));
  CHECK_FALSE(contains(infer("'" + kAnimals + "/../characters/cap_boy.png'" + net).err, "--joint-net"));
}

TEST_CASE("a model that looks to the side, and not to +z, was written without a word") {
  const TempDir dir;
  const ToolRun run =
      infer("'" + kAnimals + "/walking_dog.png' '" + kAnimals + "/../characters/side_zombie.png' '" +
            kAnimals + "/../characters/cap_boy.png' --json -o '" + dir.path() + "'");
  REQUIRE(run.exit_code == 0);
  for (const char* said :
       {"\"template\":\"quadruped\",\"facing_deg\":-90.0", "\"template\":\"biped\",\"facing_deg\":-90.0",
        "\"template\":\"biped\",\"facing_deg\":0.0"})
    CHECK(contains(run.out, said));
  CHECK(contains(infer("'" + kAnimals + "/walking_dog.png' --template quadruped -o '" + dir.path() + "'").out,
                 "  looking left\n"));
  const ToolRun silhouette =
      infer("'" + kAnimals + "/walking_dog.png' --formats silhouette --json -o '" + dir.path() + "'");
  CHECK(contains(silhouette.out, "\"facing_deg\":null"));
}
