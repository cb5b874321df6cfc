// skel-train joints: the same net whatever the number of threads, and after a stop.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/layers/part_net.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/skeleton/skeleton_file.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

namespace skel {
namespace {

std::string command(const TempDir& dir, const std::string& output, const std::string& options,
                    int steps = 6) {
  return "skel-train joints --steps " + std::to_string(steps) +
         " --batch 4 --figures 64 --validation 8 --report-every 1 -o '" + dir.file(output) + "' " + options;
}

// One drawing to learn from.
std::string drawings(const TempDir& dir) {
  std::filesystem::create_directories(dir.file("drawings"));
  for (const char* end : {".png", ".mask.png", ".joints.json"})
    std::filesystem::copy_file(SKEL_DATASETS "/characters/cap_boy" + std::string(end),
                               dir.file("drawings/cap_boy") + end);
  return " --drawn .5 --drawings '" + dir.file("drawings") + "'";
}

TEST_CASE("joint training gives the same bytes with one thread and with several") {
  const TempDir dir;
  const std::string from = drawings(dir);
  REQUIRE(runTool(command(dir, "one.bin", "--threads 1" + from)).exit_code == 0);
  REQUIRE(runTool(command(dir, "three.bin", "--threads 3" + from)).exit_code == 0);
  REQUIRE(runTool(command(dir, "other.bin", "--seed 2 --threads 3" + from)).exit_code == 0);
  CHECK(readFile(dir.file("one.bin")) == readFile(dir.file("three.bin")));
  CHECK(readFile(dir.file("one.bin")) != readFile(dir.file("other.bin")));
}

TEST_CASE("joint training that was killed goes on from its checkpoint to the same net") {
  const TempDir dir;
  const std::string from = drawings(dir), checkpoint = dir.file("state");
  REQUIRE(runTool(command(dir, "whole.bin", from)).exit_code == 0);
  const std::string resumable = command(dir, "resumed.bin", "--checkpoint '" + checkpoint + "'" + from);
  runTool("sh -c \"" + resumable + " & pid=\\$!; while [ ! -e '" + checkpoint +
          "' ] && kill -0 \\$pid; do sleep 0.01; done; kill -9 \\$pid; wait\"");
  REQUIRE(std::filesystem::exists(checkpoint));
  const auto resumed = runTool(resumable);
  REQUIRE(resumed.exit_code == 0);
  CHECK(readFile(dir.file("whole.bin")) == readFile(dir.file("resumed.bin")));
  // Its first report is not the first of all.
  CHECK(resumed.out.find("step 1 ") == std::string::npos);
  // One that is done trains nothing, and says so.
  std::filesystem::remove(dir.file("resumed.bin"));
  const auto again = runTool(resumable);
  CHECK(again.exit_code == 0);
  CHECK(again.err.find("note: " + checkpoint + ": has made all steps of its training") != std::string::npos);
  CHECK(readFile(dir.file("whole.bin")) == readFile(dir.file("resumed.bin")));
}

TEST_CASE("a checkpoint is there when its report is printed, and Ctrl+C says how to go on") {
  const TempDir dir;
  const std::string state = dir.file("state"), base = "cd '" + dir.path() + "'; ";
  const std::string train = command(dir, "n.bin", "--checkpoint state");
  CHECK(runTool(base + train +
                " | { while read -r line; do case $line in step*) test -e state && echo kept; break;; esac; "
                "done; cat >/dev/null; }")
            .out == "kept\n");
  std::filesystem::remove(state);
  const auto interrupted = [&](const std::string& options, const std::string& file) {
    return runTool(base + "env --default-signal=INT " + command(dir, "n.bin", options, 100000) +
                   " >reports & while [ ! -e " + file + " ]; do sleep .02; done; kill -INT $!; wait $!")
        .err;
  };
  const std::string with = interrupted("--checkpoint state", "state");
  CAPTURE(with);
  CHECK(with.find("skel-train: interrupted; the same line goes on from step ") != std::string::npos);
  CHECK(with.find(", as state has it\n") != std::string::npos);
  std::filesystem::remove(dir.file("n.bin"));
  CHECK(interrupted("", "n.bin")
            .find("skel-train: interrupted; the same line begins anew; one with --checkpoint "
                  "FILE can be gone on with\n") != std::string::npos);
}

TEST_CASE(
    "joint training goes on from a net with a folder of mended drawings, and measures on one left out") {
  const TempDir dir;
  const std::string from = drawings(dir);
  // What people save: joints placed in the window, a skeleton that was mended.
  for (const char* name : {"ninja", "pirate"})
    for (const char* end : {".png", ".mask.png", ".labels.json"})
      std::filesystem::copy_file(SKEL_DATASETS "/characters/" + std::string(name) + end,
                                 dir.file("drawings/") + name + end);
  // Nobody has looked at this one.
  std::filesystem::copy_file(SKEL_DATASETS "/characters/runner.png", dir.file("drawings/runner.png"));
  std::filesystem::copy_file(SKEL_DATASETS "/characters/runner.mask.png",
                             dir.file("drawings/runner.mask.png"));
  LabelFile found = readLabelFile(SKEL_DATASETS "/characters/runner.labels.json");
  for (const auto& [name, place] : found.joints) found.recognized.push_back(name);
  writeLabelFile(dir.file("drawings/runner.labels.json"), found);
  REQUIRE(runTool(command(dir, "first.bin", "")).exit_code == 0);
  const auto result =
      runTool(command(dir, "mine.bin", "--left-out .34 --start '" + dir.file("first.bin") + "'" + from));
  CHECK(result.exit_code == 0);
  CHECK(result.err.find("skel-train: note: " + dir.file("drawings/runner.labels.json") +
                        ": without a joint that a person has placed, not learned from\n") !=
        std::string::npos);
  CHECK(result.out.find("2 drawings are learned from, 1 left out to measure by\n") != std::string::npos);
  CHECK(result.out.ends_with("wrote " + dir.file("mine.bin") + "\n"));
  CHECK(result.out.find("before: 1 drawings left out: joints within 5 % ") != std::string::npos);
  CHECK(result.out.find("after: 1 drawings left out: joints within 5 % ") != std::string::npos);
  CHECK(readFile(dir.file("mine.bin")) != readFile(dir.file("first.bin")));

  const auto hard = runTool(
      command(dir, "hard.bin", "--hard 2 --left-out 0 --start '" + dir.file("first.bin") + "'" + from));
  CHECK(hard.exit_code == 0);
  CHECK(hard.out.find("3 of 3 drawings are hard") != std::string::npos);
  CHECK(hard.out.find("3 drawings are learned from; none is left out to measure by (--left-out 0)\n") !=
        std::string::npos);
  const auto nothing = runTool(command(dir, "hard.bin", "--hard 2" + from));
  CHECK(nothing.exit_code == 1);
  CHECK(nothing.err.find("--hard needs --start and --drawings") != std::string::npos);

  CHECK(runTool(command(dir, "rehearsed.bin",
                        "--left-out .34 --start '" + dir.file("first.bin") + "' --rehearse '" +
                            dir.file("drawings") + "'" + from))
            .exit_code == 0);
  const auto alone = runTool(command(
      dir, "n.bin", "--start '" + dir.file("first.bin") + "' --rehearse '" + dir.file("drawings") + "'"));
  CHECK(alone.exit_code == 1);
  CHECK(alone.err.find("--rehearse needs --start and --drawings") != std::string::npos);

  const std::string start = "--left-out 0 --start '" + dir.file("first.bin") + "'" + from;
  REQUIRE(runTool(command(dir, "larger.bin", "--hourglasses 2 " + start)).exit_code == 0);
  const JointNet larger = parseJointNet(readFile(dir.file("larger.bin")), "larger.bin");
  CHECK(larger.hourglasses == 2);
  const auto shrunk = runTool(
      command(dir, "n.bin", "--hourglasses 1 --left-out 0 --start '" + dir.file("larger.bin") + "'" + from));
  CHECK(shrunk.exit_code == 1);
  CHECK(shrunk.err.find("has 2, which can grow but not shrink") != std::string::npos);

  const auto animal =
      runTool(command(dir, "n.bin", "--template quadruped --start '" + dir.file("first.bin") + "'"));
  CHECK(animal.exit_code == 2);
  CHECK(animal.err.find("finds the joints of a biped, not of a quadruped") != std::string::npos);
  const auto old = runTool(
      command(dir, "n.bin", "--start '" SKEL_DATASETS "/../weights/archive/joint-net-version-2.bin'"));
  CHECK(old.exit_code == 2);
  CHECK(old.err.find("comes from a former version of skel-train") != std::string::npos);
}

TEST_CASE("drawings left out to measure by were rehearsed, or learned from in a copy") {
  const TempDir dir;
  const std::string from = drawings(dir);
  const auto copy = [&](const std::string& name, const std::string& to) {
    for (const char* end : {".png", ".mask.png", ".joints.json"})
      std::filesystem::copy_file(SKEL_DATASETS "/characters/" + name + end, dir.file("drawings/" + to) + end);
  };
  copy("ninja", "ninja");
  copy("ninja", "twin");
  REQUIRE(runTool(command(dir, "first.bin", "", 1)).exit_code == 0);
  const auto result = runTool(command(dir, "mine.bin",
                                      "--left-out .5 --start '" + dir.file("first.bin") + "' --rehearse '" +
                                          dir.file("drawings") + "'" + from,
                                      1));
  CHECK(result.exit_code == 0);
  const std::string twins = dir.file("drawings/ninja.png") + ", " + dir.file("drawings/twin.png");
  CHECK(result.err.find("skel-train: note: 2 drawings are one picture (" + twins +
                        "): they are left out together\n") != std::string::npos);
  CHECK(result.err.find("skel-train: note: " + twins + ": left out to measure by, so not rehearsed\n") !=
        std::string::npos);
  CHECK(result.out.find("1 drawings are learned from, 1 rehearsed, 2 left out to measure by\n") !=
        std::string::npos);
}

TEST_CASE("bones of drawn figures are measured, and a net keeps them when it is trained on") {
  const TempDir dir;
  const std::string net = dir.file("net.bin"), measured = dir.file("measured.bin");
  std::filesystem::copy_file(SKEL_DATASETS "/../weights/archive/joint-net-pass-1.bin", net);
  const auto result = runTool("skel-train bones '" + net + "' -o '" + measured +
                              "' --drawings '" SKEL_DATASETS "/unseen/characters'");
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("left_elbow ") != std::string::npos);
  const JointNet read = parseJointNet(readFile(measured), measured);
  CHECK(parseJointNet(readFile(net), net).bones.empty());
  REQUIRE(read.bones.size() == read.joints.size());
  for (std::size_t j = 0; j < read.joints.size(); ++j) {
    INFO(read.joints[j]);
    const bool in_limb = read.joints[j].ends_with("elbow") || read.joints[j].ends_with("hand") ||
                         read.joints[j].ends_with("knee") || read.joints[j].ends_with("foot");
    CHECK((read.bones[j].deviation > 0) == in_limb);
    if (read.joints[j] == "left_hand" || read.joints[j] == "right_foot") {
      CHECK(std::abs(read.bones[j].ratio_mean) < .2);
      CHECK(read.bones[j].ratio_deviation == Approx(.2).margin(.15));
    }
  }
  REQUIRE(runTool(command(dir, "on.bin", "--start '" + measured + "'")).exit_code == 0);
  CHECK(parseJointNet(readFile(dir.file("on.bin")), "on.bin").bones[3].mean == read.bones[3].mean);
}

TEST_CASE("joint training refuses what it cannot go on from or learn from") {
  const TempDir dir;
  writeFile(dir.file("state"), "short");
  const auto bad = runTool(command(dir, "n.bin", "--checkpoint '" + dir.file("state") + "'"));
  CHECK(bad.exit_code == 2);
  CHECK(bad.err.ends_with("is no checkpoint of this net\n"));  // it may be anything: nobody says to remove it
  CHECK(runTool(command(dir, "n.bin", "--hold-back 99")).exit_code == 1);
  const auto empty = runTool(command(dir, "n.bin", "--drawings '" + dir.path() + "'"));
  CHECK(empty.exit_code == 2);
  CHECK(empty.err.find("has no drawing with known joints") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(dir.file("n.bin")));
}

TEST_CASE("a checkpoint of a negative step, or of what is no number, is refused") {
  const TempDir dir;
  const std::string train = command(dir, "n.bin", "--checkpoint '" + dir.file("state") + "'");
  REQUIRE(runTool(train).exit_code == 0);
  const std::string state = readFile(dir.file("state"));
  const std::size_t begin = state.find('\n') + 1;  // behind what it was made by
  const std::int64_t step = -7;
  const float number = std::nanf(""), square = -1;
  const auto refuses = [&](std::size_t at, const auto& value) {
    std::string damaged = state;
    std::memcpy(damaged.data() + begin + at, &value, sizeof value);
    writeFile(dir.file("state"), damaged);
    const auto run = runTool(train);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("is a damaged checkpoint: remove it to start anew") != std::string::npos);
  };
  const std::size_t head = state.find('\n', begin) + 1 - begin, first = head + sizeof step,
                    quarter = (state.size() - begin - first) / 4;
  CHECK(state.substr(begin, head) == "{\"format\":\"skel-checkpoint\",\"version\":1}\n");
  refuses(head, step);
  refuses(first + 4, number);
  refuses(first + 2 * quarter, square);
}

TEST_CASE("the mean of a net and itself is that net, the mean of two lies between them") {
  const TempDir dir;
  const std::string archive = SKEL_DATASETS "/../weights/archive/", tool = "skel-train average '";
  const std::string kind = GENERATE("joint", "part", "page");
  const std::string a = archive + kind + (kind == "part" ? "-net-version-1.bin" : "-net-pass-1.bin"),
                    b = archive + kind + "-net-pass-2.bin";
  REQUIRE(runTool(tool + a + "' '" + a + "' -o '" + dir.file("same.bin") + "'").exit_code == 0);
  REQUIRE(runTool(tool + a + "' '" + b + "' -o '" + dir.file("mean.bin") + "'").exit_code == 0);
  const auto parameters = [&](const std::string& file) {
    return kind == "part"   ? parsePartNet(readFile(file), file).parameters
           : kind == "page" ? parsePageNet(readFile(file), file).parameters
                            : parseJointNet(readFile(file), file).parameters;
  };
  const auto of_a = parameters(a), of_b = parameters(b), same = parameters(dir.file("same.bin")),
             mean = parameters(dir.file("mean.bin"));
  REQUIRE(same.size() == of_a.size());
  double off = 0, apart = 0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    REQUIRE(std::abs(same[i] - of_a[i]) < 1e-6);
    off += std::abs(mean[i] - (of_a[i] + of_b[i]) / 2);
    apart += std::abs(of_a[i] - of_b[i]);
  }
  CHECK(off < .5 * apart);
}

TEST_CASE("nets of two kinds have no mean") {
  const TempDir dir;
  const std::string archive = SKEL_DATASETS "/../weights/archive/", tool = "skel-train average '";
  const auto refused = runTool(tool + archive + "joint-net-pass-1.bin' '" + archive +
                               "quadruped-joint-net-pass-1.bin' -o '" + dir.file("none.bin") + "'");
  CHECK(refused.exit_code == 2);
  CHECK(refused.err.find("is another kind of net than") != std::string::npos);
  const auto parts = runTool(tool + archive + "part-net-pass-2.bin' '" + archive +
                             "joint-net-pass-1.bin' -o '" + dir.file("none.bin") + "'");
  CHECK(parts.exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(dir.file("none.bin")));
}

TEST_CASE("joints that were mended in a skeleton file after it had been imported were left without a word") {
  const TempDir dir;
  const std::string image = dir.file("cap_boy.png"), path = dir.file("cap_boy.skeleton.json"),
                    drawing = SKEL_DATASETS "/characters/cap_boy";
  std::filesystem::copy_file(drawing + ".png", image);
  const LabelFile labels =
      labelImage(image, std::nullopt, readJointsFile(drawing + ".joints.json"), loadTemplate("biped"));
  writeLabelFile(labelFileFor(image), labels);
  SkeletonFile file;
  file.image_file = "cap_boy.png";
  file.image_sha256 = labels.image.sha256;
  file.image_width = labels.image_width;
  file.image_height = labels.image_height;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {150, 50}, {450, 550});
  for (const auto& [name, place] : labels.joints) {
    Joint& joint = file.skeleton.joints[std::size_t(file.skeleton.index(name))];
    joint.image = *place;
    joint.origin = JointOrigin::kEdited;
  }
  writeFile(path, formatSkeletonFile(file));
  const std::string train = "skel-train joints --steps 1 --batch 4 --figures 64 --validation 1 -o " +
                            dir.file("net.bin") + " --drawings " + dir.path();
  CHECK(runTool(train).err.empty());
  file.skeleton.joints[std::size_t(file.skeleton.index("left_foot"))].image.y() -= 50;
  writeFile(path, formatSkeletonFile(file));
  CHECK(runTool(train).err == "skel-train: note: " + path +
                                  " places joints elsewhere than the label file beside it; the label file "
                                  "counts (skel-label import --force takes the skeleton's)\n");
}

}  // namespace
}  // namespace skel
