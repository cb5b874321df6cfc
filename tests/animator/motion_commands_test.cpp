// list and retarget, as a user runs them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "animator/rig_text.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/animation/retarget.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/files.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_character.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"
#include "tests/support/run_tool.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

const std::string kTool = "skel-animate";
const std::string kMotions = SKEL_SOURCE_DIR "/tests/data/motions/";

std::string figureFile(const TempDir& dir) {
  const RiggedCharacter character = figure();
  const std::string path = dir.file("figure.glb");
  writeFile(path,
            encodeGlb(character, {retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton)}));
  return path;
}

void checkFails(const std::string& arguments, int exit_code, const std::string& message) {
  const ToolRun run = runTool(kTool + " " + arguments);
  CAPTURE(arguments);
  CHECK(run.exit_code == exit_code);
  CHECK(run.err == "skel-animate: " + message + "\n");
}

}  // namespace

TEST_CASE("list names the clips there are, and those of a character with its joints") {
  const TempDir dir;
  const ToolRun all = runTool(kTool + " list");
  CHECK(all.exit_code == 0);
  CHECK(all.out.find("biped:\n  idle") == 0);
  CHECK(all.out.find("quadruped:\n  idle") != std::string::npos);
  const ToolRun one = runTool(kTool + " list " + figureFile(dir));
  CHECK(one.exit_code == 0);
  CHECK(one.out.find("clips of " + dir.file("figure.glb") + ":\n  wave ") == 0);
  CHECK(one.out.find("  cheer ") != std::string::npos);
  CHECK(one.out.find("graze") == std::string::npos);
  CHECK(one.out.find("          left_hand\n") != std::string::npos);
  checkFails("list --clips-dir " + dir.file("none"), 2, dir.file("none") + ": does not exist");
}

TEST_CASE("a drawing in place of a model was called no GLB file, and not what to do") {
  const std::string drawing = SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png";
  for (const std::string& call :
       {"list " + drawing, "retarget cheer --to " + drawing + " -o /dev/null.glb"}) {
    const ToolRun run = runTool("skel-animate " + call);
    CHECK(run.exit_code == 2);
    CHECK(run.err == "skel-animate: " + drawing + ": is a drawing; `skel-infer " + drawing +
                         "` makes out/cap_boy.glb of it: name that\n");
  }
}

TEST_CASE("a list shows each joint below the one that carries it, in whatever order they come") {
  Skeleton skeleton;
  for (const auto& [name, parent] : {std::pair("pelvis", -1), {"tail", 0}, {"body", 0}, {"tail_end", 1}})
    skeleton.joints.push_back({name, parent, {}});
  std::string text;
  for (const auto& [joint, spaces] : asTree(skeleton)) text += spaces + skeleton.joints[joint].name + "\n";
  CHECK(text == "  pelvis\n    tail\n      tail_end\n    body\n");
}

TEST_CASE("a clip file goes by its path where it goes by its folder, whatever the joints are called") {
  const TempDir dir;
  const std::string model = dir.file("mixamo.glb"), clip = dir.file("clips/bend.clip.json");
  writeFile(model, encodeGlb(figure(), {}, {.naming = JointNaming::kMixamo}));
  writeFile(clip, R"({"format": "skel-clip", "version": 1, "name": "bend", "template": "biped",
    "tracks": [{"joint": "body", "angles_deg": [[0, 0, 0, 0], [1, 40, 0, 0]]}]})");
  const std::string render = kTool + " render " + model + " --fps 4 --size 16 -o ";
  for (const std::string& clips : {"bend --clips-dir " + dir.file("clips"), clip}) {
    CAPTURE(clips);
    const ToolRun run = runTool(render + dir.file("film.gif") + " --clips " + clips);
    CHECK(run.err == "");
    CHECK(run.exit_code == 0);
  }
  CHECK(runTool(kTool + " retarget " + clip + " --to " + model + " -o " + dir.file("a.glb")).exit_code == 0);
  CHECK(readGlb(dir.file("a.glb")).clips[0].tracks[0].joint == "mixamorig:Spine");
  writeFile(clip, R"({"format": "skel-clip", "version": 1, "name": "wag", "template": "quadruped",
    "tracks": [{"joint": "tail", "angles_deg": [[0, 0, 0, 0], [1, 40, 0, 0]]}]})");
  checkFails(
      "render " + model + " --clips " + clip + " -o " + dir.file("film.gif"), 2,
      clip + ": is for a quadruped, this is a biped: the clip moves \"tail\", which this character lacks");
}

TEST_CASE("retarget said nothing of the clip files that it leaves out of a folder") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  const auto clip = [&](const std::string& file, const std::string& text) {
    writeFile(dir.file("clips/" + file + ".clip.json"), text);
  };
  clip("nod", R"({"format": "skel-clip", "version": 1, "name": "nod", "template": "biped",
    "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 9, 0, 0]]}]})");
  clip("broken", "{");
  const ToolRun run = runTool("skel-animate retarget nod --clips-dir '" + dir.file("clips") + "' --to '" +
                              model + "' -o '" + dir.file("nods.glb") + "'");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("skel-animate: note: left out: " + dir.file("clips/broken.clip.json") + ": "));
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  const ToolRun without =
      runTool("skel-animate retarget nods --to '" + model + "' -o '" + dir.file("nods.glb") + "'");
  CHECK(without.exit_code == 1);
  CHECK_THAT(without.err, Catch::Matchers::EndsWith("; one of a folder of your own: --clips-dir DIR\n"));
}

TEST_CASE(
    "a clip that mixes a character's own names of joints with ours was said to lack a joint that is there") {
  const TempDir dir;
  const std::string model = dir.file("half.glb");
  RiggedCharacter half = figure();
  half.skeleton.template_name.clear();
  for (const auto& [ours, own] : std::map<std::string, std::string>{
           {"left_shoulder", "LeftArm"}, {"left_elbow", "LeftForeArm"}, {"left_hand", "LeftHand"}})
    half.skeleton.joints[std::size_t(half.skeleton.index(ours))].name = own;
  writeFile(model, encodeGlb(half, {}));
  const auto retarget = [&](const std::string& name, const std::string& joints) {
    std::string tracks;
    for (const std::string& joint : {joints.substr(0, joints.find(' ')), joints.substr(joints.find(' ') + 1)})
      tracks += (tracks.empty() ? "" : ", ") + ("{\"joint\": \"" + joint) +
                "\", \"angles_deg\": [[0, 0, 0, 0], [1, 0, 0, 9]]}";
    writeFile(dir.file("clips/" + name + ".clip.json"),
              R"({"format": "skel-clip", "version": 1, "template": "biped", "name": ")" + name +
                  "\", \"tracks\": [" + tracks + "]}");
    std::vector<ToolRun> runs;  // by path, by name
    for (const std::string& clip : {"'" + dir.file("clips/" + name + ".clip.json") + "'",
                                    name + " --clips-dir '" + dir.file("clips") + "'"})
      runs.push_back(
          runTool("skel-animate retarget " + clip + " --to '" + model + "' -o '" + dir.file("o.glb") + "'"));
    return runs;
  };
  for (const ToolRun& run : retarget("mixed", "LeftArm left_elbow")) {
    CHECK(run.exit_code != 0);
    CHECK_THAT(run.err,
               Contains("calls some joints as this character does (\"LeftArm\") and some as skel does "
                        "(\"left_elbow\", here \"LeftForeArm\"); call all by one kind of names\n"));
  }
  // All of these are the character's own names, though its template would call one of them otherwise.
  for (const ToolRun& run : retarget("own", "LeftArm right_elbow")) CHECK(run.exit_code == 0);
}

TEST_CASE("retarget writes a character, a clip or a BVH, and says what it matched") {
  const TempDir dir;
  const std::string to = " --to " + figureFile(dir) + " -o ";
  const ToolRun run =
      runTool(kTool + " retarget " + kMotions + "mixamo_prefixed.bvh" + to + dir.file("a.glb"));
  CHECK(run.exit_code == 0);
  CHECK(run.out.find("matched by name:\n  pelvis           mixamorig:Hips\n") == 0);
  CHECK(run.out.find("not matched, of the character: head_top\n") != std::string::npos);
  CHECK(run.out.find("not matched, of the motion: mixamorig:Spine,") != std::string::npos);
  const CharacterFile made = readGlb(dir.file("a.glb"));
  REQUIRE(made.clips.size() == 2);
  CHECK(made.clips[1].name == "mixamo_prefixed");

  CHECK(runTool(kTool + " retarget " + kMotions + "nameless.bvh --name step" + to + dir.file("b.clip.json"))
            .exit_code == 0);
  CHECK(readClipFile(dir.file("b.clip.json")).name == "step");

  CHECK(runTool(kTool + " retarget cheer" + to + dir.file("d.glb")).exit_code == 0);
  const CharacterFile cheering = readGlb(dir.file("d.glb"));
  REQUIRE(cheering.clips.size() == 2);
  CHECK(cheering.clips[1].name == "cheer");
  CHECK(runTool(kTool + " retarget graze" + to + dir.file("e.glb")).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(dir.file("e.glb")));

  checkFails("retarget " + kMotions + "cmu.bvh" + to + dir.file("c.fbx"), 1,
             dir.file("c.fbx") + ": must end in .glb, .clip.json or .bvh");
  checkFails(
      "retarget " + dir.file("a.glb") + to + dir.file("c.glb"), 2,
      dir.file("a.glb") +
          ": is a character, no motion; write the clip that you want of it first, `skel-animate retarget "
          "CLIP --to " +
          dir.file("a.glb") + " -o CLIP.bvh`, and give CLIP.bvh instead");
  checkFails("retarget " + dir.file("none.bvh") + to + dir.file("c.glb"), 2,
             dir.file("none.bvh") + ": cannot be read: No such file or directory");
  writeFile(dir.file("cut.bvh"), readFile(kMotions + "cmu.bvh").substr(0, 900));
  const ToolRun cut = runTool(kTool + " retarget " + dir.file("cut.bvh") + to + dir.file("c.glb"));
  CHECK(cut.exit_code == 2);
  CHECK(cut.err.find("skel-animate: " + dir.file("cut.bvh") + ": line ") == 0);
}

TEST_CASE("a second model after --to was refused as an argument that was not expected") {
  const TempDir dir;
  const std::string model = figureFile(dir);
  checkFails("retarget walk --to " + model + " b.glb -o " + dir.file("o.glb"), 1,
             "b.glb: is one too many: a run takes one motion, and one character by --to");
}

TEST_CASE("retarget gave even keys for three that ease, to the same character, without a word") {
  const TempDir dir;
  const std::string glb = figureFile(dir), hello = dir.file("mine/hello.clip.json"),
                    back = dir.file("back.clip.json");
  const auto write = [&](const std::string& made_for) {
    writeFile(hello, R"({"format": "skel-clip", "version": 1, "ease": "flow", "name": "hello", )" + made_for +
                         R"(, "tracks": [{"joint": "right_shoulder",
                         "rotations": [[0, 0, 0, 0, 1], [1, 0, 0, -0.6, 0.8], [2, 0, 0, 0, 1]]}]})");
  };
  const auto keysBack = [&](const std::string& motion, const std::string& said) {
    const ToolRun run = runTool(kTool + " retarget " + motion + " --to " + glb + " -o " + back);
    CAPTURE(motion, run.err);
    CHECK(run.exit_code == 0);
    CHECK(run.out == said + "wrote " + back + "\n");
    return parseClipKeys(readFile(back), back);
  };
  write("\"rest_pose\": \"" + restPoseHash(figure().skeleton) + '"');
  ClipKeys given = parseClipKeys(readFile(hello), hello);
  given.clip.template_name = "biped";  // the character's
  CHECK(keysBack(hello, "") == given);
  CHECK(keysBack("hello --clips-dir " + dir.file("mine"), "") == given);
  const ClipKeys named = keysBack(hello + " --name other", "");
  CHECK(named.clip.name == "other");
  CHECK(named.ease == KeyEase::kFlow);

  // Fitted to the character it has other keys.
  write(R"("template": "biped")");
  const std::string note =
      ": note: its ease is written as even keys, as it is not for the rest pose of " + glb + "\n";
  CHECK(keysBack(hello, hello + note).clip.tracks[0].times_s.size() > 3);
  CHECK(keysBack("hello --clips-dir " + dir.file("mine"), "hello" + note).ease == KeyEase::kNone);
}

TEST_CASE("a motion whose joints are matched by the shape of their tree was played without a word") {
  const TempDir dir;
  const std::string glb = figureFile(dir), may_be_wrong = "by the shape of the tree, which may be wrong";
  const auto render = [&](const std::string& motion) {
    const ToolRun run = runTool(kTool + " render " + glb + " --clip " + kMotions + motion +
                                " --fps 1 --size 32 -o " + dir.file("a.gif"));
    CHECK(run.exit_code == 0);
    return run.err;
  };
  CHECK_THAT(render("nameless.bvh"), Contains("nameless.bvh are matched " + may_be_wrong));
  CHECK_THAT(render("cmu.bvh"), !Contains(may_be_wrong));
  CHECK_THAT(
      runTool(kTool + " retarget " + kMotions + "nameless.bvh --to " + glb + " -o " + dir.file("b.glb")).out,
      Contains("matched " + may_be_wrong));
}

TEST_CASE("a BVH of ours comes back as it was") {
  const TempDir dir;
  const RiggedCharacter character = figure();
  const std::string glb = figureFile(dir);
  for (const char* name : {"wave", "walk", "dance"}) {
    const std::vector<Clip> clips = {retargetToRest(clipNamed(builtinClips(), name), character.skeleton)};
    const std::string written = exportBvh({character, clips, {"figure"}})[0].bytes;
    writeFile(dir.file("in.bvh"), written);
    REQUIRE(runTool(kTool + " retarget " + dir.file("in.bvh") + " --to " + glb + " -o " + dir.file("out.bvh"))
                .exit_code == 0);
    std::istringstream a(written), b(readFile(dir.file("out.bvh")));
    std::string x, y;
    double worst = 0;
    while (a >> x) {
      REQUIRE(bool(b >> y));
      if (x.find_first_not_of("-.0123456789") == std::string::npos)
        worst = std::max(worst, std::abs(std::stod(x) - std::stod(y)));  // cm or degrees
      else
        REQUIRE(x == y);
    }
    CHECK_FALSE(bool(b >> y));
    CAPTURE(name);
    CHECK(worst < 0.003);  // of floats near no turn
  }
}

TEST_CASE(
    "a BVH of ours that another program wrote with z up comes back: limbs folded, the pelvis trembled") {
  const TempDir dir;
  const RiggedCharacter character = figure();
  const std::string glb = figureFile(dir);
  for (const char* name : {"walk", "jump"}) {
    CAPTURE(name);
    const std::vector<Clip> clips = {retargetToRest(clipNamed(builtinClips(), name), character.skeleton)};
    std::istringstream lines(exportBvh({character, clips, {"figure"}})[0].bytes);
    std::string z_up;
    bool motion = false;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "OFFSET") {
        double x, y, z;
        words >> x >> y >> z;
        line = "OFFSET " + std::to_string(x) + " " + std::to_string(-z) + " " + std::to_string(y);
      } else if (word == "CHANNELS") {
        // About z, x, y, which now are called -y, x, z.
        line = line.substr(0, line.find("Zrotation")) + "Yrotation Xrotation Zrotation";
      } else if (motion) {
        std::vector<double> numbers = {std::stod(word)};
        for (double number; words >> number;) numbers.push_back(number);
        std::swap(numbers[1], numbers[2]);
        numbers[1] = -numbers[1];
        for (std::size_t k = 3; k < numbers.size(); k += 3) numbers[k] = -numbers[k];
        line.clear();
        for (const double number : numbers) line += std::to_string(number) + " ";
      }
      if (word == "Frame") motion = true;
      z_up += line + "\n";
    }
    writeFile(dir.file("z.bvh"), z_up);
    const ToolRun run = runTool(kTool + " retarget " + dir.file("z.bvh") + " --to " + glb + " -o " +
                                dir.file("out.clip.json"));
    REQUIRE(run.exit_code == 0);
    const Clip back = parseClip(readFile(dir.file("out.clip.json")), "out.clip.json");
    for (float time_s = 0; time_s <= clips[0].duration_s(); time_s += .1f) {
      const Pose a = samplePose(back, character.skeleton, time_s),
                 b = samplePose(clips[0], character.skeleton, time_s);
      CHECK((a.root_translation - b.root_translation).norm() < 1e-3f);
      for (std::size_t j = 0; j < character.skeleton.joints.size(); ++j)
        CHECK(a.rotations[j].angularDistance(b.rotations[j]) < .02f);
    }
  }
}

TEST_CASE("a BVH whose bones have no length is refused, where it made a model of NaNs") {
  const TempDir dir;
  const std::string figure = figureFile(dir);
  std::string flat;
  std::istringstream lines(readFile(kMotions + "mixamo_prefixed.bvh"));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("OFFSET");
    flat += (at == std::string::npos ? line : line.substr(0, at) + "OFFSET 0 0 0") + "\n";
  }
  writeFile(dir.file("flat.bvh"), flat);
  checkFails("retarget " + dir.file("flat.bvh") + " --to " + figure + " -o " + dir.file("b.glb"), 2,
             dir.file("flat.bvh") + ": has bones without length, which point nowhere");
}

TEST_CASE("a clip file that puts the pelvis on the ground, or lasts 1e5 s, is one line") {
  const TempDir dir;
  const std::string to = " --to " + figureFile(dir) + " -o " + dir.file("a.glb");
  const auto write = [&](const std::string& more) {
    writeFile(dir.file("a.clip.json"),
              R"({"format": "skel-clip", "version": 1, "name": "a", )" + more +
                  R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [2, 9, 0, 0]]}]})");
  };
  write(R"("contacts": [{"joint": "pelvis", "from_s": 0, "to_s": 1}], )");
  checkFails("retarget " + dir.file("a.clip.json") + to, 2,
             dir.file("a.clip.json") +
                 ": the clip \"a\" puts \"pelvis\" on the ground, which ends no limb of two bones");
  write(R"("contacts": [{"joint": "tail", "from_s": 0, "to_s": 1}], )");
  checkFails("retarget " + dir.file("a.clip.json") + to, 2,
             dir.file("a.clip.json") + ": puts \"tail\" on the ground, which this character lacks");
  write(R"("duration_s": 100000, )");
  checkFails("retarget " + dir.file("a.clip.json") + to, 2,
             dir.file("a.clip.json") + ": duration_s: is 100000, must be between 0 and 3600");
}
