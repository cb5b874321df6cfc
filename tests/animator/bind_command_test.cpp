// bind, weights and info: what they make of the elk, and what they say to bad input.
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "libskel/import/read_character.h"
#include "tests/animator/figure_file.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/skin_checks.h"
#include "tests/support/temp_dir.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

const std::string kElk = SKEL_SOURCE_DIR "/datasets/elk/elk.obj";
const std::string kBones = SKEL_SOURCE_DIR "/datasets/elk/elk.rig.json";

ToolRun animate(const TempDir& dir, const std::string& arguments) {
  return runTool("cd '" + dir.path() + "' && skel-animate " + arguments);
}

void expect(const ToolRun& run, int exit_code, const std::string& message) {
  CAPTURE(run.err, message);
  CHECK(run.exit_code == exit_code);
  CHECK(run.err.find(message) != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

int filesIn(const std::string& dir) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(dir)) count += entry.is_regular_file();
  return count;
}

const std::string kTetrahedron =
    "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 2 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";

std::string rig(const std::string& joints, const std::string& hierarchy = "{}") {
  return "{\"joints\": [" + joints + "], \"hierarchy\": " + hierarchy + "}";
}

std::string bone(const std::string& name, const std::string& parent,
                 const std::string& head = "[0, 0.2, 0]") {
  return "{\"name\": \"" + name + "\", \"head\": " + head + ", \"tail\": [0, 1, 0], \"parent\": " + parent +
         "}";
}

}  // namespace

TEST_CASE("the clips of animals fit the bound elk, and it walks") {
  const TempDir dir;
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "' -o elk.glb").exit_code == 0);
  const ToolRun list = animate(dir, "list elk.glb");
  for (const char* name : {"idle", "walk", "gallop", "graze", "nod", "wag"})
    CHECK(list.out.find(std::string("\n  ") + name + " ") != std::string::npos);
  CHECK(list.out.find("cheer") == std::string::npos);
  const ToolRun film = animate(dir, "render elk.glb --clip walk --fps 5 --size 64x64 -o walk/");
  CHECK(film.err == "");
  CHECK(film.exit_code == 0);
  CHECK(filesIn(dir.file("walk")) == 6);
}

TEST_CASE("the elk's last bones end where its skeleton says, in what is made of its file, too") {
  const TempDir dir;
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "' --bones ends -o elk.glb").exit_code ==
          0);
  REQUIRE(animate(dir, "retarget walk --to elk.glb -o walks.glb").exit_code == 0);
  const CharacterFile elk = readGlb(dir.file("elk.glb")), walks = readGlb(dir.file("walks.glb"));
  CHECK(elk.bones == BoneStyle::kEnds);
  CHECK(walks.bones == BoneStyle::kEnds);
  CHECK(walks.character.skeleton.joints.size() == elk.character.skeleton.joints.size());
  CHECK(readFile(dir.file("walks.glb")).find("_end\"") != std::string::npos);
}

TEST_CASE("a model that nobody gave a name for took the place of another character's") {
  const TempDir dir;
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "'").exit_code == 0);
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "'").exit_code == 0);  // its own
  const std::string elk = readFile(dir.file("out/elk.glb"));
  REQUIRE(animate(dir, "retarget walk --to out/elk.glb -o walk.clip.json").exit_code == 0);
  std::filesystem::rename(dir.file("walk.clip.json"), dir.file("elk.clip.json"));
  const ToolRun refused = animate(dir, "retarget elk.clip.json --to out/elk.glb");
  CHECK(refused.exit_code == 1);
  CHECK(refused.err.find("out/elk.glb is there, and was not written by skel-animate retarget: name the file "
                         "to write by -o") != std::string::npos);
  CHECK(readFile(dir.file("out/elk.glb")) == elk);
  std::filesystem::rename(dir.file("elk.clip.json"), dir.file("stroll.clip.json"));
  CHECK(animate(dir, "retarget stroll.clip.json --to out/elk.glb").exit_code == 0);
  CHECK(std::filesystem::exists(dir.file("out/stroll.glb")));
}

TEST_CASE("the elk is bound, and its weights are saved and taken again") {
  const TempDir dir;
  const ToolRun bound = animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "' -o elk.glb");
  CHECK(bound.err == "");
  REQUIRE(bound.exit_code == 0);
  CHECK(bound.out.find("elk.rig.json: z is up; 100 % of its bones lie in the model") != std::string::npos);
  CHECK(bound.out.find("vertices bound to 37 bones by geodesic") != std::string::npos);
  const CharacterFile elk = readGlb(dir.file("elk.glb"));
  CHECK(elk.character.skeleton.joints.size() == 38);
  CHECK(elk.character.skeleton.joints[0].name == "root");
  CHECK(elk.character.skeleton.joints[1].tail.has_value());

  REQUIRE(animate(dir, "weights elk.glb -o elk.weights.json").exit_code == 0);
  REQUIRE(animate(dir, "bind elk.glb --weights elk.weights.json -o again.glb").exit_code == 0);
  const CharacterFile again = readGlb(dir.file("again.glb"));
  const Eigen::MatrixXf before = denseWeights(elk.character.weights, elk.character.skeleton),
                        after = denseWeights(again.character.weights, again.character.skeleton);
  CHECK((after - before).cwiseAbs().maxCoeff() < 5e-5f);
  REQUIRE(animate(dir, "bind elk.glb --skin idw --max-influences 1 -o one.glb").exit_code == 0);
  CHECK(readGlb(dir.file("one.glb")).character.weights.weights.col(0).minCoeff() == 1);

  const ToolRun info = animate(dir, "info elk.glb");
  CHECK(info.exit_code == 0);
  for (const char* text :
       {"5 parts", "38 joints, 37 bones", "neck_3 (0.000, 1.670, 0.780)", "weights: up to 4 joints"})
    CHECK(info.out.find(text) != std::string::npos);
  CHECK(animate(dir, "info '" + kElk + "'").out.find("5 parts") != std::string::npos);
}

TEST_CASE("info said \"1 joints\"") {
  const TempDir dir;
  RiggedCharacter whole = figure();
  whole.weights.weights.setZero();
  whole.weights.weights.col(0).setOnes();
  Clip nod;
  nod.name = "nod";
  nod.tracks = {{"head", {0, 1}, {Eigen::Quaternionf::Identity(), Eigen::Quaternionf(0.8f, 0.6f, 0, 0)}}};
  writeFile(dir.file("whole.glb"), encodeGlb(whole, {nod}));
  const std::string said = animate(dir, "info whole.glb").out;
  CHECK(said.find("moves 1 joint\n") != std::string::npos);
  CHECK(said.find("up to 1 joint a vertex") != std::string::npos);
}

TEST_CASE("info counts as many bones of a drawing's model as the window does") {
  const TempDir dir;
  figureFile(dir);
  CHECK(animate(dir, "info figure.glb").out.find("17 joints, 16 bones") != std::string::npos);
}

TEST_CASE("the up axis of a skeleton is found by where it lies, or given") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  const auto bone_at = [](const std::string& head, const std::string& tail) {
    return rig("{\"name\": \"a\", \"head\": " + head + ", \"tail\": " + tail + ", \"parent\": null}");
  };
  writeFile(dir.file("y.json"), bone_at("[0, 0.2, -0.3]", "[0, 1, -0.3]"));
  writeFile(dir.file("z.json"), bone_at("[0, 0.45, 0.4]", "[0, 0.45, 1.6]"));
  const auto says = [&](const std::string& arguments) {
    return animate(dir, "bind m.obj -o m.glb --skeleton " + arguments).out;
  };
  CHECK(says("y.json").find("y.json: y is up; 100 % of its bones lie in the model, 0 % with z up") == 0);
  CHECK(says("z.json").find("z.json: z is up; 100 % of its bones lie in the model, 0 % with y up") == 0);
  CHECK(says("z.json --up y").find("z.json: y is up (--up); 0 % of its bones lie in the model") == 0);
}

TEST_CASE("a skeleton in other units than the model was bound with none of its bones in it") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  const auto bone_from = [&](const std::string& head, const std::string& tail) {
    writeFile(dir.file("rig.json"),
              rig("{\"name\": \"a\", \"head\": " + head + ", \"tail\": " + tail + ", \"parent\": null}"));
    return animate(dir, "bind m.obj -o m.glb --skeleton rig.json");
  };
  expect(bone_from("[0, 20, 0]", "[0, 100, 0]"), 2,
         "rig.json: does not overlap with the model: the skeleton's longest side is 80, the model's 2; other "
         "units? Scale one of them by 40\n");
  expect(bone_from("[0, 7, 7]", "[0, 8, 7]"), 2, "the model's 2; move one of them to the other\n");
  CHECK_FALSE(fs::exists(dir.file("m.glb")));
  CHECK(bone_from("[0, 0.2, 0]", "[0, 1, 0]").exit_code == 0);
}

TEST_CASE("a model in centimetres was bound as a giant without a word") {
  const TempDir dir;
  writeFile(dir.file("rig.json"),
            rig("{\"name\": \"a\", \"head\": [0, 0.2, 0], \"tail\": [0, 1, 0], \"parent\": null}"));
  writeFile(dir.file("m.obj"), kTetrahedron);
  CHECK(animate(dir, "bind m.obj -o m.glb --skeleton rig.json").err == "");
  writeFile(dir.file("giant.obj"),
            std::string(kTetrahedron) + "v 0 190 0\nv 1 190 0\nv 0 190 1\nf -1 -2 -3\n");
  expect(animate(dir, "bind giant.obj -o m.glb --skeleton rig.json"), 0,
         "giant.obj: note: it is 190 m long: numbers are metres here");
}

TEST_CASE("a skeleton most of which lies beside the model was bound without a word") {
  const TempDir dir;
  nlohmann::json moved = nlohmann::json::parse(readFile(kBones));
  for (auto& joint : moved["joints"])
    for (const char* end : {"head", "tail"}) joint[end][0] = joint[end][0].get<double>() + .5;
  writeFile(dir.file("moved.rig.json"), moved.dump());
  const std::string bind = "bind '" + kElk + "' --skeleton moved.rig.json";
  const ToolRun run = animate(dir, bind + " -o elk.glb");
  expect(run, 0, "moved.rig.json: note: only ");
  CHECK(run.err.find("% of its bones lie in the model: is it this model's") != std::string::npos);
  expect(animate(dir, "render '" + kElk +
                          "' --skeleton moved.rig.json --up z --clip walk --fps 1 --size 16 -o a.gif"),
         0, "moved.rig.json: note: only ");
}

TEST_CASE("of a skeleton whose arms and legs are two bones each nobody said why no clip fits it") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  std::string joints = bone("Hips", "null", "[0, 0.6, 0]") + "," + bone("Spine", "\"Hips\"", "[0, 1, 0]");
  for (const std::string side : {"L", "R"}) {
    const std::string x = side == "L" ? "0." : "-0.", of_side = "." + side;
    joints += "," + bone("UpperArm" + of_side, "\"Spine\"", "[" + x + "1, 1.2, 0]") + "," +
              bone("LowerArm" + of_side, "\"UpperArm" + of_side + "\"", "[" + x + "2, 1.1, 0]") + "," +
              bone("UpperLeg" + of_side, "\"Hips\"", "[" + x + "1, 0.5, 0]") + "," +
              bone("LowerLeg" + of_side, "\"UpperLeg" + of_side + "\"", "[" + x + "1, 0.3, 0]");
  }
  writeFile(dir.file("rig.json"), rig(joints));
  const ToolRun bound = animate(dir, "bind m.obj --skeleton rig.json --names mixamo -o m.glb");
  REQUIRE(bound.exit_code == 0);
  CHECK(bound.out.find("the joints keep their names: --names mixamo is for bipeds whose joints are called as "
                       "skel's are (pelvis, left_elbow ...)\n") != std::string::npos);
  const std::string why =
      ": no joint for left_hand, left_foot, right_hand, right_foot; an arm or a leg is three joints, the "
      "last "
      "one at hand or foot\n";
  CHECK(animate(dir, "list m.glb").out.find("clips that fit:\n  none" + why) != std::string::npos);
  expect(animate(dir, "render m.glb --clip all -o films/"), 2,
         "none that come with skel fit its joints" + why);
}

TEST_CASE("a clip of one's own did not play on a model without one of its joints, and another was named") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  std::string joints = bone("Hips", "null", "[0, 0.6, 0]") + "," + bone("Spine", "\"Hips\"", "[0, 1, 0]") +
                       "," + bone("Head", "\"Spine\"", "[0, 1.4, 0]");
  for (const std::string side : {"L", "R"}) {
    const std::string x = side == "L" ? "0." : "-0.", of_side = "." + side;
    joints += "," + bone("UpperArm" + of_side, "\"Spine\"", "[" + x + "1, 1.2, 0]") + "," +
              bone("LowerArm" + of_side, "\"UpperArm" + of_side + "\"", "[" + x + "2, 1.1, 0]") + "," +
              bone("Hand" + of_side, "\"LowerArm" + of_side + "\"", "[" + x + "3, 1.0, 0]") + "," +
              bone("UpperLeg" + of_side, "\"Hips\"", "[" + x + "1, 0.5, 0]") + "," +
              bone("LowerLeg" + of_side, "\"UpperLeg" + of_side + "\"", "[" + x + "1, 0.3, 0]") + "," +
              bone("Foot" + of_side, "\"LowerLeg" + of_side + "\"", "[" + x + "1, 0.1, 0]");
  }
  writeFile(dir.file("rig.json"), rig(joints));
  REQUIRE(animate(dir, "bind m.obj --skeleton rig.json -o golem.glb").exit_code == 0);
  const auto write = [&](const std::string& body_plan, const std::string& tracks) {
    writeFile(dir.file("clips/slash.clip.json"),
              R"({"format": "skel-clip", "version": 1, "name": "slash", )" + body_plan + R"("tracks": [)" +
                  tracks + "]}");
  };
  const std::string neck = R"({"joint": "neck", "angles_deg": [[0, 0, 0, 0], [1, 0, 20, 0]]})",
                    arm = R"({"joint": "right_shoulder", "angles_deg": [[0, 0, 0, 0], [1, -90, 0, 0]]})";
  const std::string film = "render golem.glb --fps 4 --size 16 -o film.gif --clip ";
  for (const std::string body_plan : {"", "\"template\": \"biped\", "}) {
    write(body_plan, neck + "," + arm);
    for (const std::string call : {"clips/slash.clip.json", "slash --clips-dir clips"})
      expect(animate(dir, film + call), 0,
             "golem.glb: note: the clip \"slash\" plays without \"neck\", which this character lacks\n");
    CHECK(animate(dir, "retarget clips/slash.clip.json --to golem.glb -o a.glb")
              .out.find("plays without \"neck\"") != std::string::npos);
    CHECK(readGlb(dir.file("a.glb")).clips[0].tracks[0].joint == "UpperArm.R");
    write(body_plan, neck);
    expect(animate(dir, film + "clips/slash.clip.json"), 2,
           "clips/slash.clip.json: moves \"neck\", which this character lacks");
    expect(animate(dir, film + "slash --clips-dir clips"), 1,
           "the clip \"slash\" moves \"neck\", which this character lacks");
  }
}

TEST_CASE("a biped's clip was refused for an animal by a joint that this has") {
  const TempDir dir;
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "' -o elk.glb").exit_code == 0);
  const std::string bull = SKEL_SOURCE_DIR "/datasets/animals/leaping_bull.png";
  const std::string turn = R"("angles_deg": [[0, 0, 0, 0], [1, 0, 0, 20]]})",
                    body = R"({"joint": "body", )" + turn, hand = R"({"joint": "left_hand", )" + turn;
  const auto write = [&](const std::string& name, const std::string& contacts, const std::string& tracks) {
    writeFile(dir.file("clips/" + name + ".clip.json"), R"({"format": "skel-clip", "version": 1, "name": ")" +
                                                            name + R"(", "template": "biped", )" + contacts +
                                                            R"("tracks": [)" + tracks + "]}");
  };
  const std::string stands = R"("contacts": [{"joint": "left_foot", "from_s": 0, "to_s": 1}], )";
  write("bow", "", body);
  write("wink", "", body + "," + hand);
  write("stand", stands, body);
  const auto film = [&](const std::string& character, const std::string& clips) {
    return animate(dir, "render '" + character + "' --fps 2 --size 32 -o a.gif --clip " + clips);
  };
  for (const std::string& animal : {std::string("elk.glb"), bull}) {
    CAPTURE(animal);
    const auto note = [&](const std::string& clip) {
      return animal + ": note: is a quadruped, the clip \"" + clip + "\" is for a biped\n";
    };
    expect(film(animal, "clips/bow.clip.json"), 0, note("bow"));
    CHECK(film(animal, "clips/wink.clip.json").err ==
          note("wink") + animal +
              ": note: the clip \"wink\" plays without \"left_hand\", which this character lacks\n");
    expect(film(animal, "clips/stand.clip.json"), 2,
           "clips/stand.clip.json: is for a biped, this is a quadruped: the clip puts \"left_foot\" on the "
           "ground, which a quadruped lacks; without \"contacts\" its file plays as far as it fits\n");
    expect(film(animal, "bow --clips-dir clips"), 1,
           "the clip \"bow\" is for a biped, this is a quadruped: the clip plays as far as it fits where its "
           "file is named (--clip FILE)\n");
  }
  // Of several drawings it is as with a name.
  const std::string boy = SKEL_SOURCE_DIR "/datasets/characters/dancer.png";
  const std::string both = "render '" + boy + "' '" + bull + "' --fps 2 --size 32 --clips ";
  const std::string why = bull + ": note: clips/stand.clip.json: is for a biped, this is a quadruped: ";
  const ToolRun sheet = animate(dir, both + "walk,clips/stand.clip.json --sheet sheet/");
  expect(sheet, 0, why);
  CHECK(sheet.err.find(": left out\n") != std::string::npos);
  const ToolRun together = animate(dir, both + "clips/stand.clip.json -o both.gif");
  expect(together, 0, why);
  CHECK(together.err.find(": \"walk\" instead\n") != std::string::npos);
}

TEST_CASE("a person's motion moved an animal without a word") {
  const TempDir dir;
  REQUIRE(animate(dir, "bind '" + kElk + "' --skeleton '" + kBones + "' -o elk.glb").exit_code == 0);
  const std::string motion = SKEL_SOURCE_DIR "/tests/data/motions/rokoko.bvh";
  const ToolRun run = animate(dir, "render elk.glb --clip '" + motion + "' --fps 2 --size 32 -o elk.gif");
  CHECK(run.exit_code == 0);
  CHECK(run.err.find("elk.glb: note: is a quadruped, " + motion + " a biped's motion: it moves ") !=
        std::string::npos);
  // Its legs end where it leaps, not near the ground.
  const std::string bull = SKEL_SOURCE_DIR "/datasets/animals/leaping_bull.png";
  const ToolRun leaping =
      animate(dir, "render '" + bull + "' --clip '" + motion + "' --fps 2 --size 32 -o bull.gif");
  CHECK(leaping.exit_code == 0);
  CHECK(leaping.err.find(bull + ": note: is a quadruped, ") != std::string::npos);
}

TEST_CASE("bad skeletons are refused with the place in them, and nothing is written") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  struct Case {
    std::string text, message;
  };
  const std::vector<Case> cases = {
      {"", "s.json: is empty, not JSON"},
      {"[]", "s.json: must be an object"},
      {"{}", "s.json: lacks \"joints\""},
      {rig(""), "s.json: joints: is empty"},
      {rig(bone("a", "null") + "," + bone("a", "null")),
       "s.json: joints[1].name: \"a\" is also the name of joints[0]"},
      {rig(bone("a", "null") + "," + bone("b", "\"c\"")),
       "s.json: joints[1].parent: there is no joint \"c\""},
      {rig(bone("a", "null") + "," + bone("b", "null")),
       "s.json: joints[1]: \"b\" has no parent, but \"a\" is the root; only one joint may have none"},
      {rig(bone("a", "\"b\"") + "," + bone("b", "\"a\"")), "s.json: joints[0]: \"a\" is its own ancestor"},
      {rig(bone("r", "null") + "," + bone("a", "\"b\"") + "," + bone("b", "\"a\"")),
       "s.json: joints[1]: \"a\" is its own ancestor"},
      {rig("{\"name\": \"a\", \"position\": [0, 1, 0]}"),
       "s.json: joints[0]: lacks \"head\"; a joint is written {\"name\": \"spine\", \"head\": [x, y, z], "
       "\"tail\": [x, y, z], \"parent\": \"pelvis\"}, as docs/formats.md shows under \"Skeletons of "
       "models\""},
      {rig(bone("a", "null", "[0, 1]")), "s.json: joints[0].head: has 2 numbers, must have 3"},
      {rig(bone("a", "null", "[0, NaN, 0]")), "joints[0].head[1] is not a finite number"},
      {rig(bone("a", "null", "[0, 1e30, 0]")), "s.json: joints[0].head: is farther than 1e6 from the origin"},
      {rig(bone("a", "null", "[0, \"x\", 0]")), "s.json: joints[0].head[1]: must be a number"},
      {rig(bone("a", "\"b\"") + "," + bone("b", "null"), "{\"a\": \"c\"}"),
       "s.json: joints[0].parent: is \"b\", but hierarchy.a is \"c\""},
      {rig(bone("a", "null"), "{\"x\": \"a\"}"), "s.json: hierarchy.x: there is no joint \"x\""},
      {rig(bone("a", "null") + "," + bone("b", "null"), "{\"a\": \"r\", \"b\": \"q\"}"),
       "s.json: hierarchy.b: there is no joint \"q\"; only one may be missing, the root, and \"r\" is"},
      {"{\"format\": \"skel-skeleton\", \"version\": 9}", "s.json: "},
  };
  for (const Case& c : cases) {
    writeFile(dir.file("s.json"), c.text);
    expect(animate(dir, "bind m.obj --skeleton s.json -o m.glb"), 2, c.message);
  }
  CHECK(filesIn(dir.path()) == 2);
}

TEST_CASE("the elk system's own skeleton.json binds: what it has besides joints is left alone, and said") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  writeFile(dir.file("skeleton.json"), R"({
    "joints": [
      {"name": "hips", "index": 0, "head": [0, 0.2, 0], "tail": [0, 1, 0], "parent": null, "children": ["chest"]},
      {"name": "chest", "index": 1, "head": [0, 1, 0], "tail": [0, 1.6, 0], "parent": "hips", "children": []}
    ],
    "bones": [
      {"name": "hips", "start_joint": "hips", "end_joint": "chest", "parent": null, "children": ["chest"]},
      {"name": "chest", "start_joint": "chest", "end_joint": "chest_end", "parent": "hips", "children": []}
    ],
    "hierarchy": {"hips": null, "chest": "hips"}
  })");
  const ToolRun run = animate(dir, "bind m.obj --skeleton skeleton.json -o m.glb");
  CHECK(run.err == "");
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("\nskeleton.json: bones, joints[].children are not used\n") != std::string::npos);
  CHECK(readGlb(dir.file("m.glb")).character.skeleton.joints.size() == 2);
}

TEST_CASE("bad models, weights and tables are refused, and nothing is written") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  writeFile(dir.file("s.json"), rig(bone("a", "null") + "," + bone("b", "\"a\"")));
  const auto bind = [&](const std::string& arguments) {
    return animate(dir, "bind " + arguments + " -o out.glb");
  };
  expect(animate(dir, "bind m.obj --skeleton s.json -o e.fbx"), 1, "e.fbx: must end in .glb");
  expect(animate(dir, "weights m.obj --skeleton s.json -o x.txt"), 1, "x.txt: must end in .json");
  expect(bind("m.obj"), 1, "m.obj has no skeleton of its own; name one by --skeleton FILE");
  expect(bind("gone.obj --skeleton s.json"), 2, "gone.obj: cannot be read: No such file or directory");
  expect(bind("gone.glb"), 2, "gone.glb: cannot be read: No such file or directory");
  expect(bind("m.stl --skeleton s.json"), 2, "m.stl: is an STL file");
  writeFile(dir.file("bad.obj"), kTetrahedron + "f 1 2 9\n");
  expect(bind("bad.obj --skeleton s.json"), 2, "bad.obj: line 9: there is no vertex 9; 4 are defined so far");
  writeFile(dir.file("bad.obj"), "v 0 0 0\n");
  expect(bind("bad.obj --skeleton s.json"), 2, "bad.obj: holds no faces");
  writeFile(dir.file("bad.obj"), "v 1e9 0 0\nv 0 1e9 0\nv 0 0 1e9\nf 1 2 3\n");
  expect(bind("bad.obj --skeleton s.json"), 2,
         "bad.obj: line 1: a vertex is farther than 1e6 from the origin");
  writeFile(dir.file("bad.obj"), "v 1e-9 0 0\nv 0 1e-9 0\nv 0 0 1e-9\nf 1 2 3\n");
  expect(bind("bad.obj --skeleton s.json"), 2, "bad.obj: is smaller than 1e-6");
  writeFile(dir.file("bad.glb"), "glTF and then nothing");
  expect(bind("bad.glb"), 2, "bad.glb: is of glTF version");
  expect(bind("m.obj --skeleton s.json --skin magic"), 1, "--skin: magic not in {");
  expect(bind("m.obj --skeleton s.json --max-influences 5"), 1, "--max-influences: ");
  expect(bind("m.obj --skeleton s.json --up x"), 1, "--up: x not in {");
  expect(bind("m.obj --skeleton s.json --regions r.json"), 1, "--regions goes with --skin idw-region");
  expect(bind("m.obj --skeleton s.json --skin idw-region --regions r.json"), 2, "r.json: cannot be read");

  const auto weights = [](const std::string& vertices) {
    return "{\"format\": \"skel-skin\", \"version\": 1, \"joints\": [\"a\", \"b\"], \"vertices\": [" +
           vertices + "]}";
  };
  const std::string one = "{\"joints\": [0], \"weights\": [1]}";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {weights(one), "w.json: vertices: are 1, the model has 4"},
      {weights(one + "," + one + "," + one + ",{\"joints\": [2], \"weights\": [1]}"),
       "w.json: vertices[3].joints[0]: is 2, must be a whole number between 0 and 1"},
      {weights(one + "," + one + "," + one + ",{\"joints\": [0], \"weights\": [-1]}"),
       "w.json: vertices[3].weights[0]: "},
      {weights(one + "," + one + "," + one + ",{\"joints\": [0], \"weights\": [0]}"),
       "w.json: vertices[3].weights: are all 0"},
      {"{\"format\": \"skel-skin\", \"version\": 1, \"joints\": [\"z\"], \"vertices\": []}",
       "w.json: joints[0]: the skeleton has no joint \"z\""},
  };
  for (const auto& [text, message] : bad) {
    writeFile(dir.file("w.json"), text);
    expect(bind("m.obj --skeleton s.json --weights w.json"), 2, message);
  }
  CHECK_FALSE(fs::exists(dir.file("out.glb")));
  CHECK(fs::exists(dir.file("m.obj")));
}

TEST_CASE("weights of an OBJ are one for each of its lines, or for each vertex with copies at seams") {
  const TempDir dir;
  writeFile(dir.file("t.png"), encodePng(Image(2, 2)));
  writeFile(dir.file("m.mtl"), "newmtl m\nmap_Kd t.png\n");
  writeFile(dir.file("s.json"), rig(bone("a", "null") + "," + bone("b", "\"a\"")));
  // The first line is at a seam, so that there are four lines and five vertices.
  const std::string model = "mtllib m.mtl\nusemtl m\n" + kTetrahedron.substr(0, kTetrahedron.find('f')),
                    faces = "vt 0 0\nvt 1 1\nf 3/1 2/1 1/1\nf 1/2 2/1 4/1\nf 2/1 3/1 4/1\nf 3/1 1/1 4/1\n";
  const auto weights = [&](const std::vector<int>& joints) {
    std::string vertices;
    for (const int joint : joints)
      vertices +=
          (vertices.empty() ? "" : ",") + ("{\"joints\": [" + std::to_string(joint)) + "], \"weights\": [1]}";
    writeFile(dir.file("w.json"),
              "{\"format\": \"skel-skin\", \"version\": 1, \"joints\": [\"a\", \"b\"], "
              "\"vertices\": [" +
                  vertices + "]}");
    return animate(dir, "bind m.obj --skeleton s.json --weights w.json -o m.glb");
  };
  // In the order of the vertices of m.glb.
  const auto bound = [&] {
    const SkinWeights read = readGlb(dir.file("m.glb")).character.weights;
    return std::vector<int>(read.joints.col(0).begin(), read.joints.col(0).end());
  };
  writeFile(dir.file("m.obj"), model + faces);
  CHECK(weights({1, 0, 1, 0}).err == "");
  CHECK(bound() == std::vector<int>{1, 0, 1, 0, 1});
  CHECK(weights({1, 0, 1, 0, 0}).err == "");
  CHECK(bound() == std::vector<int>{1, 0, 1, 0, 0});
  expect(weights({1, 0, 1}), 2, "w.json: vertices: are 3, the model has 5 with copies at seams, its file 4");

  writeFile(dir.file("m.obj"), model + "v 0 9 0\n" + faces);
  expect(weights({1, 0, 1, 0, 0}), 2,
         "w.json: vertices: could be those of the model's file or of its 5 vertices with copies at seams; "
         "remove vertices without faces from the model");
}

TEST_CASE("what cannot be written leaves the old file whole") {
  const TempDir dir;
  writeFile(dir.file("m.obj"), kTetrahedron);
  writeFile(dir.file("s.json"), rig(bone("a", "null")));
  writeFile(dir.file("out.glb"), "the old one");
  // A disk that is full: no file may grow beyond a few blocks.
  const ToolRun full = runTool(
      "cd '" + dir.path() +
      "' && trap '' XFSZ && ulimit -f 1 && skel-animate bind m.obj --skeleton s.json -o out.glb >/dev/null");
  expect(full, 4, "out.glb: cannot be written: ");
  CHECK(readFile(dir.file("out.glb")) == "the old one");
  CHECK_FALSE(fs::exists(dir.file("out.glb.skel-tmp")));
  expect(animate(dir, "bind m.obj --skeleton s.json -o m.obj/out.glb"), 4, "m.obj");
}
