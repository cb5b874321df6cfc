#include "animator/document.h"

#include "animator/rig_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_character.h"
#include "tests/animator/figure_file.h"
#include "tests/support/catch.h"

using namespace skel;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
namespace fs = std::filesystem;

namespace {

constexpr double kQuarter = std::numbers::pi / 2;

int clipIndex(const AnimationDocument& document, const std::string& name) {
  for (std::size_t i = 0; i < document.clips().size(); ++i)
    if (document.clips()[i].name == name) return int(i);
  return -1;
}

// Where a joint is, in the pose that is shown.
Eigen::Vector3f at(const AnimationDocument& document, const std::string& joint) {
  return posedJoints(document.skeleton(), document.posed())[std::size_t(document.skeleton().index(joint))];
}

bool atRest(const AnimationDocument& document) {
  for (const Eigen::Quaternionf& turn : document.state().pose.rotations)
    if (!turn.isApprox(Eigen::Quaternionf::Identity())) return false;
  return true;
}

}  // namespace

TEST_CASE("a character opens in its rest pose, with its clips before those of skel") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  CHECK(document.jointCount() == 17);
  CHECK(boneCount(document.skeleton()) == 16);
  CHECK(document.clip() == nullptr);
  CHECK(document.clips()[0].name == "nod");
  CHECK(clipIndex(document, "walk") > 0);
  CHECK(atRest(document));
  CHECK_FALSE(document.canUndo());
  CHECK_THROWS_WITH(AnimationDocument({.path = dir.file("none.glb")}), Contains("none.glb: cannot be read"));
  CHECK_THROWS_WITH(AnimationDocument({.path = dir.file("model.stl")}),
                    Contains("model.stl: is an STL file"));
}

TEST_CASE("playing goes round, or stops at the end") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.playing = true;
  CHECK_FALSE(document.advance(0.1));  // there is nothing to play
  CHECK_FALSE(document.playing);

  document.chooseClip(0);
  document.playing = true;
  CHECK(document.advance(0.25));
  CHECK(document.state().time_s == Approx(0.25));
  CHECK(document.anglesOf(document.skeleton().index("head")).x() == Approx(0.3).margin(1e-5));
  document.speed = 2;
  CHECK(document.advance(0.5));
  CHECK(document.state().time_s == Approx(0.25));  // once round
  document.speed = -1;
  CHECK(document.advance(0.5));
  CHECK(document.state().time_s == Approx(0.75));
  document.speed = 1;
  document.loops = false;
  CHECK(document.advance(10));
  CHECK(document.state().time_s == 1);
  CHECK_FALSE(document.playing);
  document.setTime(-3);
  CHECK(document.state().time_s == 0);
}

TEST_CASE("without a clip there is nothing to play, and that is said") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  CHECK_FALSE(document.canPlay());
  document.playOrPause();
  CHECK_FALSE(document.playing);
  CHECK(document.clip() == nullptr);
  CHECK_THAT(document.message(), Contains("choose a clip"));

  document.chooseClip(0);
  CHECK(document.canPlay());
  document.playOrPause();
  CHECK(document.playing);
  document.loops = false;
  document.advance(10);
  document.playOrPause();  // at the end: once more
  CHECK(document.playing);
  CHECK(document.state().time_s == 0);
  document.playOrPause();
  CHECK_FALSE(document.playing);
}

TEST_CASE("a joint turns about its own axes, and the numbers say so") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int elbow = document.skeleton().index("left_elbow");
  const Eigen::Vector3f hand = at(document, "left_hand"), middle = at(document, "left_elbow");
  document.turnJoint(elbow, 2, kQuarter);
  const Eigen::Vector3f expected = middle + Eigen::Vector3f(-(hand - middle).y(), (hand - middle).x(), 0);
  CHECK((at(document, "left_hand") - expected).norm() < 1e-5f);
  CHECK(document.anglesOf(elbow).isApprox(Eigen::Vector3d(0, 0, kQuarter), 1e-6));
  // About the axis as it stands now: the second turn's x is the model's y.
  document.turnJoint(elbow, 0, 0.3);
  const Eigen::Vector3f axis = document.posed()[std::size_t(elbow)].linear().col(0);
  CHECK((axis - Eigen::Vector3f::UnitY()).norm() < 1e-5f);

  for (const Eigen::Vector3d& angles :
       {Eigen::Vector3d(0.3, -0.7, 2.5), Eigen::Vector3d(-3, 1.2, -0.1), Eigen::Vector3d(0.4, kQuarter, 0)}) {
    document.setAngles(elbow, angles);
    const Eigen::Vector3d again = document.anglesOf(elbow);
    const auto turn = document.state().pose.rotations[std::size_t(elbow)];
    CHECK(turn.angularDistance(rotationOfAngles(again.cast<float>())) < 1e-3f);
    if (angles.y() < 1.5) CHECK((again - angles).norm() < 1e-5);
  }
  document.resetJoint(elbow);
  CHECK(atRest(document));
}

TEST_CASE("every step is undone and done again, and a drag is one step") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int knee = document.skeleton().index("right_knee");
  document.beginStep();
  for (int i = 0; i < 10; ++i) document.turnJoint(knee, 0, 0.1);
  document.endStep();
  CHECK(document.anglesOf(knee).x() == Approx(1).margin(1e-5));
  document.chooseClip(0);
  document.setTime(0.5);
  document.turnJoint(knee, 0, 0.5);
  document.setKey();
  CHECK(document.clip()->tracks.size() == 2);

  CHECK(document.undo());
  CHECK(document.clip()->tracks.size() == 1);
  CHECK(document.state().time_s == 0.5);
  CHECK(document.undo());
  CHECK(document.undo());
  CHECK(document.clip() == nullptr);
  CHECK(document.anglesOf(knee).x() == Approx(1).margin(1e-5));
  CHECK(document.undo());
  CHECK(atRest(document));
  CHECK_FALSE(document.undo());
  while (document.redo()) {
  }
  CHECK(document.clip()->tracks.size() == 2);
  document.undo();
  document.turnJoint(knee, 1, 0.1);
  CHECK_FALSE(document.canRedo());
}

TEST_CASE("a joint that has not been turned since its last key gets none in the place of the chosen one") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int shoulder = document.skeleton().index("right_shoulder"),
            elbow = document.skeleton().index("right_elbow");
  for (int degrees = -175; degrees <= 175; degrees += 5) {
    CAPTURE(degrees);
    document.newClip("hold", 2);
    document.setTime(.6);
    document.setAngles(shoulder, {0, .3, degrees * std::numbers::pi / 180});
    document.setKey();
    document.setTime(1.4);
    document.choose(elbow);
    document.setKey();
    REQUIRE(document.clip()->tracks.size() == 2);
    CHECK(document.clip()->tracks[0].times_s.size() == 1);
    CHECK(document.clip()->tracks[1].joint == "right_elbow");
  }
}

TEST_CASE("keys hold what was turned, scrubbing shows what the keys say") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int arm = document.skeleton().index("left_shoulder"), head = document.skeleton().index("head");
  document.setKey();
  CHECK_THAT(document.message(), Contains("keys need a clip"));
  document.newClip("nod", 2);
  CHECK(document.clip()->name == "nod-2");  // the first is the file's own
  CHECK(document.duration_s() == 2);
  document.choose(arm);
  document.setKey();  // as it rests
  document.setTime(1);
  document.turnJoint(arm, 2, 1);
  document.turnJoint(head, 0, 0.4);
  document.setKey();
  CHECK(document.keyTimes() == std::vector<double>{0, 1});
  document.choose(-1);
  document.setTime(0.5);
  CHECK(document.anglesOf(arm).z() == Approx(0.5).margin(1e-5));
  document.turnJoint(arm, 2, 3);  // not keyed: gone with the next moment
  document.setTime(1);
  CHECK(document.anglesOf(arm).z() == Approx(1).margin(1e-5));
  document.choose(arm);
  document.removeKey();
  CHECK(document.keyTimes() == std::vector<double>{0});
  CHECK(document.anglesOf(arm).z() == 0);
  CHECK(document.anglesOf(head).x() == Approx(0.4).margin(1e-5));
  document.choose(-1);
  document.removeKey();
  CHECK(document.clip()->tracks.size() == 1);
  document.setDuration(5);
  CHECK(document.duration_s() == 5);
}

TEST_CASE("a new clip begins in the rest pose and has tracks only for what was turned") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.chooseClip(clipIndex(document, "walk"));
  document.setTime(0.3);
  REQUIRE_FALSE(atRest(document));
  document.newClip("mine", 2);
  CHECK(atRest(document));
  CHECK(document.state().pose.root_translation.norm() == 0);
  document.setTime(1);
  document.turnJoint(document.skeleton().index("head"), 0, 0.4);
  document.setKey();
  REQUIRE(document.saveClip(dir.file("mine.clip.json")));
  const Clip saved = readClipFile(dir.file("mine.clip.json"));
  REQUIRE(saved.tracks.size() == 1);
  CHECK(saved.tracks[0].joint == "head");
  CHECK(saved.tracks[0].times_s == std::vector<float>{1});
  CHECK(saved.root_times_s.empty());
  while (document.clip()->name == "mine") REQUIRE(document.undo());
  CHECK(document.clip()->name == "walk");
  CHECK_FALSE(atRest(document));
}

TEST_CASE("poses, clips, weights, skeletons and characters come back from their files") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int arm = document.skeleton().index("left_shoulder");
  document.turnJoint(arm, 2, 1.25);
  const Pose pose = document.state().pose;
  REQUIRE(document.savePose(dir.file("a.pose.json")));
  document.resetPose();
  REQUIRE(document.loadPose(dir.file("a.pose.json")));
  for (std::size_t j = 0; j < pose.rotations.size(); ++j)
    CHECK(document.state().pose.rotations[j].isApprox(pose.rotations[j], 1e-6f));

  document.newClip("mine", 1);
  document.setTime(1);
  document.turnJoint(arm, 2, 0.75);
  document.setKey();
  REQUIRE(document.saveClip(dir.file("mine.clip.json")));
  REQUIRE(document.saveModel(dir.file("posed.glb")));
  const CharacterFile saved = readGlb(dir.file("posed.glb"));
  CHECK(saved.clips.size() == document.clips().size());
  AnimationDocument other({.path = figureFile(dir, "other.glb")});
  REQUIRE(other.loadClip(dir.file("mine.clip.json")));
  CHECK(other.clip()->name == "mine");
  other.setTime(1);
  CHECK(other.anglesOf(arm).z() == Approx(0.75).margin(1e-4));
  CHECK(other.clips().size() == document.clips().size());

  REQUIRE(document.saveWeights(dir.file("a.weights.json")));
  const SkinWeights before = document.character().weights;
  REQUIRE(document.loadWeights(dir.file("a.weights.json")));
  CHECK((document.character().weights.weights - before.weights).cwiseAbs().maxCoeff() < 2e-6f);
  CHECK(document.character().weights.joints == before.joints);

  REQUIRE(document.saveSkeleton(dir.file("a.rig.json")));
  REQUIRE(document.loadSkeleton(dir.file("a.rig.json")));
  CHECK(document.jointCount() == 17);
  for (const Joint& joint : figureSkeleton().joints)
    CHECK((document.skeleton().joints[std::size_t(document.skeleton().index(joint.name))].position -
           joint.position)
              .norm() < 1e-6);
  CHECK(document.undo());
  CHECK(document.character().weights.joints == before.joints);
}

TEST_CASE("a clip comes back from its file with the keys that were set, for the character it was made for") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int head = document.skeleton().index("head");
  document.choose(head);
  document.newClip("my-clip", 2);
  document.setKey();
  document.setTime(0.995);
  document.turnJoint(head, 1, 0.8);
  document.setKey();
  const Clip made = *document.clip();
  REQUIRE(made.tracks.size() == 1);
  CHECK(made.tracks[0].times_s == std::vector<float>{0, 1});
  REQUIRE(document.saveClip(dir.file("my-clip.clip.json")));
  CHECK(*document.clip() == made);
  Clip read = made;
  read.template_name = "biped";

  AnimationDocument again({.path = figureFile(dir, "again.glb")});
  REQUIRE(again.loadClip(dir.file("my-clip.clip.json")));
  CHECK(*again.clip() == read);
  again.choose(head);
  again.scrub(1.01);
  again.removeKey();
  CHECK(again.keyTimes() == std::vector<double>{0});
  REQUIRE(document.saveModel(dir.file("saved.glb")));
  AnimationDocument from_model({.path = dir.file("saved.glb")});
  REQUIRE(from_model.loadClip(dir.file("my-clip.clip.json")));
  CHECK(*from_model.clip() == read);

  // Another one's rest pose: it is fitted to that.
  RiggedCharacter other = figure();
  other.skeleton.joints[std::size_t(head)].position.y() += 0.02;
  writeFile(dir.file("other.glb"), encodeGlb(other, {}));
  AnimationDocument on_other({.path = dir.file("other.glb")});
  REQUIRE(on_other.loadClip(dir.file("my-clip.clip.json")));
  CHECK(on_other.clip()->tracks[0].times_s.size() > 2);
  CHECK(on_other.fileForClip() == dir.file("my-clip-other.clip.json"));
  on_other.setTime(1);
  CHECK(on_other.anglesOf(head).y() == Approx(0.8).margin(0.01));
}

TEST_CASE("a clip was saved over what a script had made of its file since it was loaded") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const std::string path = dir.file("mine.clip.json");
  document.newClip("mine", 1);
  document.turnJoint(document.skeleton().index("left_shoulder"), 2, 0.75);
  document.setKey();
  REQUIRE(document.saveClip(path));
  REQUIRE(document.saveClip(path));
  const std::string theirs = readFile(path) + "\n";
  writeFile(path, theirs);
  CHECK_FALSE(document.saveClip(path));
  CHECK_THAT(document.message(), Contains("mine.clip.json: was changed elsewhere since"));
  document.turnJoint(document.skeleton().index("left_shoulder"), 2, 0.25);
  REQUIRE(document.undo());
  CHECK(document.message() == "undone; changed elsewhere since it was read or saved here: " + path);
  REQUIRE(document.redo());
  CHECK(document.message() == "done again; changed elsewhere since it was read or saved here: " + path);
  CHECK(readFile(path) == theirs);
  CHECK(document.saveClip(dir.file("other.clip.json")));
  REQUIRE(document.loadClip(path));
  CHECK(document.saveClip(path));
}

TEST_CASE(
    "nothing is saved over a file of the clips' folder that has changed, though the window has not read it") {
  const TempDir dir;
  const std::string path = dir.file("clips/stand.pose.json");
  writeFile(path, "{}");
  writeFile(
      dir.file("clips/nod.clip.json"),
      R"({"format":"skel-clip","version":1,"name":"nod","tracks":[{"joint":"head","angles_deg":[[0,0,0,0],[1,9,0,0]]}]})");
  ClipSource library;
  library.clips_dir = dir.file("clips");
  AnimationDocument document({.path = figureFile(dir)}, library);
  writeFile(path, "{ }");
  CHECK_FALSE(document.savePose(path));
  CHECK_THAT(document.message(), Contains("stand.pose.json: was changed elsewhere since"));
  CHECK(readFile(path) == "{ }");
}

TEST_CASE("a clip that eases comes back with its keys and its ease, and plays as others play its file") {
  const TempDir dir;
  const std::string path = dir.file("bow.clip.json");
  AnimationDocument document({.path = figureFile(dir)});
  const int head = document.skeleton().index("head");
  document.choose(head);
  document.newClip("bow", 2);
  document.setKey();
  document.setTime(2);
  document.turnJoint(head, 0, 0.8);
  document.setKey();
  REQUIRE(document.saveClip(path));
  std::string text = readFile(path);
  text.insert(text.find("\"rest_pose\""), "\"ease\": \"rest\",\n  ");
  writeFile(dir.file("eased/bow.clip.json"), text);

  AnimationDocument again({.path = figureFile(dir, "again.glb")});
  REQUIRE(again.loadClip(dir.file("eased/bow.clip.json")));
  CHECK(again.message() == "loaded " + dir.file("eased/bow.clip.json"));
  again.choose(head);
  CHECK(again.keyTimes() == std::vector<double>{0, 2});
  CHECK(again.unsavedClips().empty());
  again.setTime(0.5);
  CHECK(again.anglesOf(head).x() == Approx(0.8 * (0.5 - 0.5 * std::cos(std::numbers::pi / 4))).margin(2e-3));
  REQUIRE(again.saveClip(dir.file("saved/bow.clip.json")));
  CHECK(readFile(dir.file("saved/bow.clip.json")) == text);
  const Clip played = readClipFile(dir.file("eased/bow.clip.json"));
  CHECK(again.clip()->tracks == played.tracks);

  // To another character it is fitted without it.
  RiggedCharacter other = figure();
  other.skeleton.joints[std::size_t(head)].position.y() += 0.02;
  writeFile(dir.file("other.glb"), encodeGlb(other, {}));
  AnimationDocument on_other({.path = dir.file("other.glb")});
  REQUIRE(on_other.loadClip(dir.file("eased/bow.clip.json")));
  CHECK_THAT(on_other.message(), EndsWith("; its ease is even keys here, as it is not for this character's "
                                          "rest pose"));
  REQUIRE(on_other.loadClip(path));
  CHECK_THAT(on_other.message(), Contains("; its keys at 2 moments are at ") &&
                                     EndsWith(" here, as it is not for this character's rest pose"));

  // A model has the even keys that the clip plays by.
  REQUIRE(again.saveModel(dir.file("saved.glb")));
  const std::vector<Clip> clips = readGlb(dir.file("saved.glb")).clips;
  const auto bow = std::find_if(clips.begin(), clips.end(), [](const Clip& c) { return c.name == "bow"; });
  REQUIRE(bow != clips.end());
  CHECK(bow->tracks[0].times_s.size() == 61);

  again.setTime(1);
  again.turnJoint(head, 0, 0.1);
  again.setKey();
  CHECK(again.keyTimes() == std::vector<double>{0, 1, 2});
  again.renameClip("deep-bow");
  REQUIRE(again.saveClip(dir.file("deep-bow.clip.json")));
  const ClipKeys deep = parseClipKeys(readFile(dir.file("deep-bow.clip.json")), "deep-bow.clip.json");
  CHECK(deep.ease == KeyEase::kRest);
  CHECK(deep.clip.tracks[0].times_s == std::vector<float>{0, 1, 2});
  CHECK(again.undo());
  CHECK(again.undo());
  CHECK(again.keyTimes() == std::vector<double>{0, 2});
}

TEST_CASE("a clip of --clips-dir that eases is edited by its own keys, as one that is opened") {
  const TempDir dir;
  const std::string path = dir.file("mine/bow.clip.json");
  AnimationDocument document({.path = figureFile(dir)});
  document.choose(document.skeleton().index("head"));
  document.newClip("bow", 2);
  document.setKey();
  document.setTime(2);
  document.turnJoint(document.skeleton().index("head"), 0, 0.8);
  document.setKey();
  REQUIRE(document.saveClip(path));
  std::string text = readFile(path);
  text.insert(text.find("\"rest_pose\""), "\"ease\": \"rest\",\n  ");
  writeFile(path, text);

  ClipSource library;
  library.clips_dir = dir.file("mine");
  AnimationDocument again({.path = figureFile(dir, "again.glb")}, library);
  const auto isEdited = [&] {
    const auto& clips = again.clips();
    again.chooseClip(
        int(std::find_if(clips.begin(), clips.end(), [](const Clip& c) { return c.name == "bow"; }) -
            clips.begin()));
    again.choose(again.skeleton().index("head"));
    CHECK(again.keyTimes() == std::vector<double>{0, 2});
    REQUIRE(again.saveClip(dir.file("saved/bow.clip.json")));
    CHECK(readFile(dir.file("saved/bow.clip.json")) == text);
  };
  isEdited();
  CHECK(again.unsavedClips().empty());
  REQUIRE(again.openModel(figureFile(dir, "third.glb")));
  isEdited();
}

TEST_CASE("a clip of --clips-dir was saved elsewhere than in the file that it came from") {
  const TempDir dir;
  const std::string path = dir.file("mine/hello.clip.json");
  const auto write = [&](const std::string& file, const std::string& made_for) {
    writeFile(file,
              R"({"format": "skel-clip", "version": 1, "name": "hello", )" + made_for +
                  R"(, "tracks": [{"joint": "head", "rotations": [[0, 0, 0, 0, 1], [1, 0, 0, 0.6, 0.8]]}]})");
  };
  const std::string own = "\"rest_pose\": \"" + restPoseHash(figure().skeleton) + '"';
  write(path, own);
  ClipSource library;
  library.clips_dir = dir.file("mine");
  const auto fileAfterChange = [&](AnimationDocument& document) {
    document.chooseClip(clipIndex(document, "hello"));
    document.turnJoint(document.skeleton().index("neck"), 0, 0.3);
    document.setKey();
    return document.fileOfClip();
  };
  AnimationDocument document({.path = figureFile(dir)}, library);
  CHECK(document.fileOfClip().empty());
  document.chooseClip(clipIndex(document, "walk"));
  CHECK(document.fileOfClip().empty());
  CHECK(fileAfterChange(document) == path);
  REQUIRE(document.saveClip(dir.file("out/hello.clip.json")));
  CHECK(document.fileOfClip() == dir.file("out/hello.clip.json"));
  document.newClip("mine", 1);
  CHECK(document.fileOfClip().empty());
  REQUIRE(document.loadClip(path));
  CHECK(document.fileOfClip() == path);

  // A file for the canonical pose would not be so any more.
  write(path, R"("template": "biped")");
  AnimationDocument fitted({.path = figureFile(dir)}, library);
  CHECK(fileAfterChange(fitted).empty());
}

TEST_CASE("a joint that no skin follows was turned and keyed as if it moved something") {
  const TempDir dir;
  RiggedCharacter character = figure();
  const Skeleton& skeleton = character.skeleton;
  for (Eigen::Index v = 0; v < character.weights.joints.rows(); ++v)
    for (Eigen::Index k = 0; k < character.weights.joints.cols(); ++k)
      if (skeleton.joints[character.weights.joints(v, k)].name.starts_with("left_"))
        character.weights.joints(v, k) = 0;
  writeFile(dir.file("armless.glb"), encodeGlb(character, {nodClip()}));
  AnimationDocument document({.path = dir.file("armless.glb")});
  const int elbow = document.skeleton().index("left_elbow");
  const std::string note = "\"left_elbow\" moves nothing of this figure: no skin follows it";
  document.choose(elbow);
  CHECK(document.message() == note);
  document.choose(document.skeleton().index("right_elbow"));
  CHECK(document.message().empty());
  document.choose(elbow);
  document.chooseClip(0);
  document.setKey();
  document.turnJoint(elbow, 0, 0.5);
  CHECK(document.message() == note);
  document.say("");
  document.setAngles(elbow, {0.1, 0, 0});
  CHECK(document.message() == note);
  document.say("");
  for (const char* joint : {"right_elbow", "pelvis", "head"}) {
    document.choose(document.skeleton().index(joint));
    document.turnJoint(document.chosen(), 0, 0.5);
  }
  document.choose(-1);
  CHECK(document.message().empty());
}

TEST_CASE("a copy of a clip file kept the window from opening") {
  const TempDir dir;
  for (const char* file : {"reach.clip.json", "reach (copy).clip.json"})
    writeFile(dir.file(std::string("mine/") + file),
              R"({"format": "skel-clip", "version": 1, "name": "reach", "template": "biped",
                 "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 40, 0, 0]]}]})");
  writeFile(dir.file("mine/broken.clip.json"), "{");
  ClipSource library;
  library.clips_dir = dir.file("mine");
  const AnimationDocument document({.path = figureFile(dir)}, library);
  CHECK(hasClip(document.clips(), "reach"));
  CHECK_THAT(document.message(), Contains("left out: " + dir.file("mine/broken.clip.json")) &&
                                     Contains("is the second clip \"reach\""));
}

TEST_CASE("a pose is taken as a motion of one key") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int arm = document.skeleton().index("left_shoulder");
  document.turnJoint(arm, 2, 1.25);
  REQUIRE(document.savePose(dir.file("hello.pose.json")));
  document.resetPose();
  REQUIRE(document.loadClip(dir.file("hello.pose.json")));
  CHECK(document.clip()->name == "hello");
  CHECK(document.anglesOf(arm).z() == Approx(1.25).margin(1e-4));
  CHECK(document.keyTimes() == std::vector<double>{0});
}

TEST_CASE("times are those of keys, of the end, or of frames") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.newClip("mine", 1.01);
  const auto scrubbed = [&](double time_s) {
    document.scrub(time_s);
    return document.state().time_s;
  };
  CHECK(scrubbed(0.5049) == Approx(0.5));
  CHECK(scrubbed(0.5171) == Approx(16 / 30.));
  CHECK(scrubbed(1.002) == 1);
  CHECK(scrubbed(1.007) == double(1.01f));
  CHECK(scrubbed(7) == double(1.01f));
  CHECK(scrubbed(-1) == 0);
  document.chooseClip(0);  // with keys at 0, 0.5, 1
  CHECK(scrubbed(0.51) == 0.5);
}

TEST_CASE("clips that no file holds are known, and a save, a load or undo changes that") {
  using Names = std::vector<std::string>;
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  CHECK(document.unsavedClips().empty());
  document.newClip("my-clip", 1);
  CHECK(document.unsavedClips().empty());  // it moves nothing
  document.turnJoint(document.skeleton().index("head"), 0, 0.5);
  document.setKey();
  CHECK(document.unsavedClips() == Names{"my-clip"});
  document.undo();
  CHECK(document.unsavedClips().empty());
  document.redo();
  CHECK(document.unsavedBelow(dir.file("none.clip.json")).empty());
  REQUIRE_FALSE(document.saveClip("/dev/null/my-clip.clip.json"));
  CHECK(document.unsavedClips() == Names{"my-clip"});
  REQUIRE(document.saveClip(dir.file("my-clip.clip.json")));
  CHECK(document.unsavedClips().empty());
  CHECK(document.unsavedBelow(dir.file("my-clip.clip.json")).empty());
  document.turnJoint(document.skeleton().index("head"), 0, 0.5);
  document.setKey();
  document.chooseClip(clipIndex(document, "nod"));
  document.turnJoint(document.skeleton().index("head"), 0, 0.5);
  document.setKey();
  CHECK(document.unsavedClips() == Names{"nod", "my-clip"});
  CHECK(document.unsavedBelow(dir.file("my-clip.clip.json")) == "my-clip");
  REQUIRE(document.loadClip(dir.file("my-clip.clip.json")));
  CHECK(document.unsavedClips() == Names{"nod"});
  REQUIRE(document.saveModel(dir.file("saved.glb")));
  CHECK(document.unsavedClips().empty());
}

TEST_CASE("a clip counted as saved that undo brought back from before its file was saved over") {
  using Names = std::vector<std::string>;
  const TempDir dir;
  const std::string figure = figureFile(dir);
  const std::string file = dir.file("salute.clip.json");
  AnimationDocument document({.path = figure});
  const int head = document.skeleton().index("head");
  const auto turnAndKey = [head](AnimationDocument& in) {
    in.turnJoint(head, 0, 0.5);
    in.setKey();
  };
  document.newClip("salute", 1);
  turnAndKey(document);
  REQUIRE(document.saveClip(file));
  turnAndKey(document);
  SECTION("in this window") {
    REQUIRE(document.saveClip(file));
    while (document.clip() && document.unsavedClips().empty()) document.undo();
    CHECK(document.unsavedClips() == Names{"salute"});
    REQUIRE(document.saveClip(dir.file("second.clip.json")));
    CHECK(document.unsavedClips().empty());
  }
  SECTION("in a folder of clips") {
    ClipSource folder;
    folder.clips_dir = dir.path();
    AnimationDocument next({.path = figure}, folder);
    next.chooseClip(clipIndex(next, "salute"));
    turnAndKey(next);
    REQUIRE(next.saveClip(file));
    CHECK(next.unsavedClips().empty());
    while (next.undo() && next.unsavedClips().empty()) {
    }
    CHECK(next.unsavedClips() == Names{"salute"});
  }
}

TEST_CASE("joints that were turned and have no key were lost without a question") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int head = document.skeleton().index("head");
  CHECK_FALSE(document.hasUnsavedPose());
  document.turnJoint(head, 0, kQuarter);
  CHECK(document.hasUnsavedPose());
  SECTION("a saved pose is not lost, one that is turned on is") {
    REQUIRE(document.savePose(dir.file("bow.pose.json")));
    CHECK_FALSE(document.hasUnsavedPose());
    document.turnJoint(head, 0, kQuarter / 2);
    CHECK(document.hasUnsavedPose());
    REQUIRE(document.loadPose(dir.file("bow.pose.json")));
    CHECK_FALSE(document.hasUnsavedPose());
  }
  SECTION("nor is a key") {
    document.newClip("bow", 1);
    CHECK_FALSE(document.hasUnsavedPose());
    document.turnJoint(head, 0, kQuarter);
    CHECK(document.hasUnsavedPose());
    document.setKey();
    CHECK_FALSE(document.hasUnsavedPose());
  }
  SECTION("nor what undo takes back") {
    document.undo();
    CHECK_FALSE(document.hasUnsavedPose());
  }
}

TEST_CASE("a pose without a key was lost with a click on the time line, and undo did not bring it back") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const int arm = document.skeleton().index("left_shoulder");
  document.newClip("throw", 2);
  document.setTime(0.5);
  document.turnJoint(arm, 2, 1);
  document.scrub(1.5);
  CHECK_THAT(document.message(), Contains("undo brings it back"));
  document.scrub(1.6);  // a drag goes on
  document.playing = true;
  document.advance(0.1);
  CHECK(atRest(document));
  REQUIRE(document.undo());
  CHECK(document.state().time_s == 0.5);
  CHECK(document.anglesOf(arm).z() == Approx(1).margin(1e-5));
  REQUIRE(document.redo());
  CHECK(atRest(document));
  REQUIRE(document.undo());
  document.setKey();
  document.setTime(1);
  REQUIRE(document.undo());  // the key: time alone is no step
  CHECK(document.clip()->tracks.empty());
}

TEST_CASE("a key between two frames left joints as they stood before it, which no key holds") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.chooseClip(clipIndex(document, "walk"));
  document.setTime(0.49);
  document.turnJoint(document.skeleton().index("head"), 0, 1);
  document.setKey();
  CHECK_FALSE(document.hasUnsavedPose());
}

TEST_CASE("a clip is called as its file, unless somebody has named it, and names are free") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const auto make = [&] {
    document.newClip("my-clip", 1);
    document.turnJoint(document.skeleton().index("head"), 0, 0.5);
    document.setKey();
  };
  make();
  REQUIRE(document.saveClip(dir.file("bow.clip.json")));
  CHECK(document.clip()->name == "bow");
  CHECK(readClipFile(dir.file("bow.clip.json")).name == "bow");
  CHECK(document.unsavedClips().empty());
  REQUIRE(document.saveClip(dir.file("other.clip.json")));
  // It kept its name, so that the folder held two clips of one name.
  CHECK(readClipFile(dir.file("other.clip.json")).name == "other");
  CHECK(document.clip()->name == "other");
  document.undo();
  CHECK(document.clip()->name == "bow");
  document.undo();
  CHECK(document.clip()->name == "my-clip");
  document.redo();
  document.redo();

  make();
  REQUIRE(document.saveClip(dir.file("walk.clip.json")));  // skel's own is called so
  CHECK(document.clip()->name == "my-clip");
  CHECK_THAT(document.message(), Contains("still called \"my-clip\", as there is another \"walk\""));
  document.renameClip("other");
  CHECK(document.clip()->name == "my-clip");
  CHECK_THAT(document.message(), Contains("there is a clip \"other\" already"));
  document.renameClip("");
  CHECK(document.clip()->name == "my-clip");
  document.renameClip("deep bow");
  CHECK(document.clip()->name == "deep bow");
  REQUIRE(document.saveClip(dir.file("file.clip.json")));
  CHECK(readClipFile(dir.file("file.clip.json")).name == "deep bow");
  CHECK_THAT(document.message(), EndsWith("file.clip.json; the clip is still called \"deep bow\""));
}

TEST_CASE("a clip of skel that was changed and saved as another file kept its name in that") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.chooseClip(clipIndex(document, "wave"));
  document.turnJoint(document.skeleton().index("head"), 0, 0.5);
  document.setKey();
  REQUIRE(document.saveClip(dir.file("wave2.clip.json")));
  CHECK_THAT(document.message(), EndsWith("wave2.clip.json; the clip is now called \"wave2\""));
  CHECK(readClipFile(dir.file("wave2.clip.json")).name == "wave2");
  CHECK(document.clip()->name == "wave2");
  CHECK(document.unsavedClips().empty());
  // A file whose clip is called otherwise goes back as it is.
  std::string text = readFile(dir.file("wave2.clip.json"));
  text.replace(text.find("\"wave2\""), 7, "\"hello\"");
  writeFile(dir.file("wave2.clip.json"), text);
  REQUIRE(document.loadClip(dir.file("wave2.clip.json")));
  REQUIRE(document.saveClip(dir.file("wave2.clip.json")));
  CHECK(readClipFile(dir.file("wave2.clip.json")).name == "hello");
}

TEST_CASE("a clip that the window saved did not say for which body plan it is") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  document.newClip("mine", 1);
  document.turnJoint(document.skeleton().index("head"), 0, 0.5);
  document.setKey();
  REQUIRE(document.saveClip(dir.file("mine.clip.json")));
  CHECK(readClipFile(dir.file("mine.clip.json")).template_name == "biped");
  CHECK(document.unsavedClips().empty());
  REQUIRE(document.loadClip(dir.file("mine.clip.json")));
  CHECK(document.unsavedClips().empty());
}

TEST_CASE("what cannot be loaded or saved is said in one line, and changes nothing") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const auto refused = [&](bool done, const std::string& reason) {
    CHECK_FALSE(done);
    CHECK_THAT(document.message(), Contains(reason));
    CHECK(document.message().find('\n') == std::string::npos);
    CHECK_FALSE(document.canUndo());
  };
  refused(document.openModel(dir.file("none.glb")), "none.glb: cannot be read");
  writeFile(dir.file("a.json"), R"({"format": "skel-pose", "version": 1, "joints": {"wing": {}}})");
  refused(document.loadPose(dir.file("a.json")), "a.json: joints.wing: is a joint that this character lacks");
  writeFile(dir.file("a.json"),
            R"({"format": "skel-pose", "version": 1, "joints": {"head": {"rotation": [1, 2, 3, 4]}}})");
  refused(document.loadPose(dir.file("a.json")), "joints.head.rotation: is no rotation");
  // Infinite, as a float.
  writeFile(dir.file("a.json"),
            R"({"format": "skel-pose", "version": 1, "joints": {"head": {"scale": [1e39, 1, 1]}}})");
  refused(document.loadPose(dir.file("a.json")), "joints.head.scale: holds a number that is too large");
  writeFile(dir.file("a.json"), R"({"format": "skel-pose", "version": 9, "joints": {}})");
  refused(document.loadPose(dir.file("a.json")), "version");
  writeFile(dir.file("a.json"),
            R"({"format": "skel-skin", "version": 1, "joints": ["head"], "vertices": []})");
  refused(document.loadWeights(dir.file("a.json")), "vertices: are 0, the model has");
  refused(document.loadWeights(dir.file("none.json")), "cannot be read");
  refused(document.saveClip(dir.file("a.clip.json")), "there is no clip to save");
  writeFile(dir.file("file"), "");
  refused(document.savePose(dir.file("file/a.pose.json")), "a.pose.json: cannot make its folder");
  refused(document.exportFilm(dir.file("a.avi"), Camera(), {}) != nullptr, "films are written as .mp4");
}

TEST_CASE("the joint under the mouse is the nearest one") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const Camera camera = framingCamera(document.character().mesh.vertices);
  const Projection projection(camera, 400, 400);
  for (const char* name : {"head", "left_hand", "right_knee"}) {
    const int joint = document.skeleton().index(name);
    const Eigen::Vector2d px = *projection(document.skeleton().joints[std::size_t(joint)].position);
    CHECK(document.jointAt(px + Eigen::Vector2d(2, -1), projection, 10) == joint);
  }
  CHECK(document.jointAt({5, 5}, projection, 10) == -1);
}

TEST_CASE("a film is written beside the work, and can be stopped") {
  const TempDir dir;
  AnimationDocument document({.path = figureFile(dir)});
  const Camera camera = framingCamera(document.character().mesh.vertices);
  FilmOptions options;
  options.width = options.height = 64;
  auto film = document.exportFilm(dir.file("pose/"), camera, options);
  REQUIRE(film);
  film->finish();
  CHECK(film->isDone());
  CHECK(filesBelow(dir.file("pose")).size() == 1);  // the rest pose
  document.chooseClip(0);
  film = document.exportFilm(dir.file("nod/"), camera, options);
  REQUIRE(film);
  film->finish();
  CHECK(filesBelow(dir.file("nod")).size() == 30);
  CHECK(film->share() == 1);

  options.duration_s = 600;
  film = document.exportFilm(dir.file("long.gif"), camera, options);
  REQUIRE(film);
  film.reset();
  CHECK_FALSE(fs::exists(dir.file("long.gif")));
}
