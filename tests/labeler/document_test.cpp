#include "labeler/document.h"

#include "labeler/last_shown.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/label_file.h"
#include "tests/labeler/drawing_folder.h"
#include "tests/support/catch.h"
#include "tests/support/locked_folder.h"
#include "tests/support/run_tool.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

// Every kind of step, at random places.
void randomStep(Document& document, Rng& rng) {
  const auto place = [&] { return Eigen::Vector2d(rng.uniform(150, 450), rng.uniform(80, 540)); };
  const auto joint_class = [&] { return static_cast<JointClass>(rng.below(kJointClassCount)); };
  const auto candidates = [&] {
    const Eigen::Vector2d p = place();
    return document.candidatesNear(p, rng.uniform(5, 80));
  };
  switch (rng.below(12)) {
    case 11:
      return document.acceptMask();
    case 10:
      return document.paintLayer(place(), place(), rng.uniform(2, 40),
                                 layerBrushes(document.bodyPlan())[rng.below(9)]);
    case 0:
      return document.label(candidates(), std::nullopt);
    case 1:
    case 2:
      return document.label(candidates(), joint_class());
    case 3:
      return document.acceptSuggestions();
    case 4:
      return document.labelFromJoints();
    case 5:
      return document.moveJoint(static_cast<int>(rng.below(17)), place());
    case 6: {
      const Eigen::Vector2d from = place(), to = place();
      return document.paintMask(from, to, rng.uniform(2, 20), rng.chance(0.5));
    }
    case 7:
      return document.forgetMask();
    case 8:
      return document.rigAnew();
    default: {
      document.beginStep();  // a stroke
      const JointClass painted = joint_class();
      for (int i = 0; i < 3; ++i) document.label(candidates(), painted);
      return document.endStep();
    }
  }
}

// Two characters as the frames of a motion, without joints in the second.
std::string motionOfTwo(const TempDir& dir) {
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion;
  motion.frame_rate = 12;
  for (const char* name : {"cap_boy", "box_robot"}) {
    copyCharacter(name, dir.file("frames"), false);
    MotionFrame& frame = motion.frames.emplace_back();
    frame.image_file = std::string("frames/") + name + ".png";
    frame.image_width = frame.image_height = 600;
    frame.time_s = static_cast<double>(motion.frames.size()) / 12;
    frame.joints.resize(plan.joints.size());
  }
  for (auto& joint : motion.frames[0].joints) joint = PlacedJoint{{300, 200}, 0.5, JointOrigin::kRecognized};
  writeFile(dir.file("walk.motion.json"), formatMotionFile(motion, plan));
  return dir.file("walk.motion.json");
}

SkeletonFile skeletonOfCapBoy(const SkeletonTemplate& plan) {
  SkeletonFile file;
  file.image_file = "cap_boy.png";
  file.image_width = file.image_height = 600;
  file.skeleton = presetSkeleton(plan, {100, 50}, {500, 550});
  return file;
}

int undoAll(Document& document) {
  int count = 0;
  while (document.undo()) ++count;
  return count;
}

}  // namespace

TEST_CASE("labels are set, undone, done again, and are on the disk at once") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  const DrawingState empty = document.state();
  REQUIRE(document.item().classes.parts > 20);
  CHECK(document.item().classes.done == 0);
  CHECK_FALSE(document.canUndo());

  document.label({3, 5}, JointClass::kHand);
  CHECK(document.item().classes.done == 2);
  const LabelFile saved = readLabelFile(dir.file("cap_boy.labels.json"));
  CHECK(saved.labels[3] == JointClass::kHand);
  CHECK_FALSE(saved.labels[4]);
  CHECK(saved.mask->file == "cap_boy.mask.png");
  CHECK(findProblems(dir.file("cap_boy.labels.json")).empty());

  CHECK(document.undo());
  CHECK(document.state() == empty);
  CHECK_FALSE(readLabelFile(dir.file("cap_boy.labels.json")).labels[3]);
  CHECK(document.redo());
  CHECK(document.item().classes.done == 2);
  CHECK_FALSE(document.redo());
}

TEST_CASE("classes by joints that nobody has placed looked like those by joints of a person") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.rig();
  document.labelFromJoints();
  const Progress found = document.item().joints;
  REQUIRE(found.done == 0);
  CHECK(contains(document.message(), "changed to fit the joints, of which " + std::to_string(found.parts) +
                                         " were found, not placed"));
  document.acceptJoints();
  document.labelFromJoints();
  CHECK(document.message() == "0 labels changed to fit the joints");
}

TEST_CASE("a step that changes nothing is no step") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.label({}, JointClass::kHand);
  document.label({1}, std::nullopt);
  CHECK_FALSE(document.canUndo());
  CHECK_FALSE(fs::exists(dir.file("cap_boy.labels.json")));
}

TEST_CASE("what was saved is what a new document finds") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Rng rng(7);
  DrawingState last;
  {
    Document document(dir.path(), documentOptions());
    document.rig();
    document.moveJoint(document.bodyPlan().find("head"), {301.25, 150.5});
    document.labelFromJoints();
    document.paintMask({300, 100}, {330, 60}, 12, true);
    document.label({0}, std::nullopt);
    last = document.state();
  }
  const Document document(dir.path(), documentOptions());
  CHECK(document.message().empty());
  CHECK(document.state().labels == last.labels);
  REQUIRE(document.state().mask);
  CHECK((document.state().mask->pixels == last.mask->pixels).all());
  CHECK(document.state().mask->sha256 == last.mask->sha256);
  for (size_t j = 0; j < last.joints.size(); ++j) {
    REQUIRE(document.state().joints[j].has_value() == last.joints[j].has_value());
    CHECK(document.state().joints[j]->image == last.joints[j]->image);
    CHECK((document.state().joints[j]->origin == JointOrigin::kEdited) ==
          (last.joints[j]->origin == JointOrigin::kEdited));
  }
}

TEST_CASE("a picture that was renamed after it was labelled was opened without its labels and its mask") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const auto head = static_cast<size_t>(loadTemplate("biped").find("head"));
  {
    Document document(dir.path(), documentOptions());
    document.rig();
    document.moveJoint(int(head), {301.25, 150.5});
    document.label({0}, JointClass::kHand);
    document.paintMask({300, 100}, {330, 60}, 12, true);
  }
  const std::string mask = readFile(dir.file("cap_boy.mask.png"));
  fs::rename(dir.file("cap_boy.png"), dir.file("ben.png"));
  Document document(dir.path(), documentOptions());
  CHECK(document.message() == "as in cap_boy.labels.json, made when the picture was called cap_boy.png");
  CHECK(document.item().joints.done == 1);
  CHECK(document.state().joints[head]->image == Eigen::Vector2d(301.25, 150.5));
  CHECK(document.state().labels[0] == JointClass::kHand);
  CHECK_FALSE(fs::exists(dir.file("ben.labels.json")));
  document.label({1}, JointClass::kHead);
  CHECK(findProblems(dir.file("ben.labels.json")).empty());
  CHECK(readFile(dir.file("ben.mask.png")) == mask);
  CHECK(readFile(dir.file("cap_boy.mask.png")) == mask);
  CHECK(Document(dir.path(), documentOptions()).message().empty());
}

TEST_CASE("joints that were found, not placed, are found anew after reopening") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const auto hand = static_cast<size_t>(loadTemplate("biped").find("left_hand"));
  {
    Document document(dir.path(), documentOptions());
    document.rig();
    document.moveJoint(document.bodyPlan().find("head"), {301.25, 150.5});
  }
  Document document(dir.path(), documentOptions());
  const Eigen::Vector2d found = document.state().joints[hand]->image;
  document.paintMask(found, found, 60, false);
  document.rig();
  CHECK((document.state().joints[hand]->image - found).norm() > 20);
  CHECK(document.state().joints[static_cast<size_t>(document.bodyPlan().find("head"))]->image ==
        Eigen::Vector2d(301.25, 150.5));
}

TEST_CASE("any sequence of steps is undone to its start and done again to its end") {
  const auto seed = GENERATE(range(1u, 7u));
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), seed % 2 == 0);
  copyCharacter("box_robot", dir.file("below"));
  Document document(dir.path(), documentOptions());
  const DrawingState start = document.state();
  document.go(1);
  const DrawingState other_start = document.state();
  document.go(0);

  Rng rng(seed);
  for (int i = 0; i < 25; ++i) {
    if (rng.chance(0.2)) document.go(static_cast<int>(rng.below(2)));
    randomStep(document, rng);
    CHECK(document.state().labels.size() == document.figure().candidates.maxima.size());
  }
  std::vector<DrawingState> end(2);
  for (int i : {0, 1}) {
    document.go(i);
    end[static_cast<size_t>(i)] = document.state();
  }

  const int steps = undoAll(document);
  CHECK(steps > 5);
  document.go(0);
  CHECK(document.state() == start);
  document.go(1);
  CHECK(document.state() == other_start);

  int again = 0;
  while (document.redo()) ++again;
  CHECK(again == steps);
  for (int i : {0, 1}) {
    document.go(i);
    // Joints come back from the disk as placed by hand, where a drawing was left in between.
    CHECK(document.state().labels == end[static_cast<size_t>(i)].labels);
    CHECK((document.state().mask == nullptr) == (end[static_cast<size_t>(i)].mask == nullptr));
    if (document.state().mask)
      CHECK((document.state().mask->pixels == end[static_cast<size_t>(i)].mask->pixels).all());
  }
}

TEST_CASE("undo goes to the drawing of the step") {
  const TempDir dir;
  copyCharacter("box_robot", dir.path());
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.label({0}, JointClass::kLeg);
  REQUIRE(document.go(1));
  CHECK(document.undo());
  CHECK(document.current() == 0);
  CHECK(document.item().classes.done == 0);
}

TEST_CASE("undo did not say what was undone on another drawing or of another kind") {
  const TempDir dir;
  copyCharacter("box_robot", dir.path());
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.paintMask({300, 100}, {330, 60}, 12, true);
  document.label({0, 1}, JointClass::kLeg);
  document.rig();
  document.moveJoint(document.bodyPlan().find("left_hand"), {301.25, 150.5});
  CHECK(document.undo());
  CHECK(document.message() == "undone: the left hand");
  CHECK(document.travelled() == std::vector{Work::kJoints});
  CHECK(document.undo());
  CHECK(document.message() == "undone: the joints");
  REQUIRE(document.go(1));
  CHECK(document.undo());
  CHECK(document.message() == "undone: the classes of 2 candidates of box_robot.png");
  CHECK(document.travelled() == std::vector{Work::kClasses});
  REQUIRE(document.go(1));
  CHECK(document.undo());
  CHECK(document.message() == "undone: a stroke of the mask of box_robot.png");
  CHECK(document.travelled() == std::vector{Work::kMask});
  CHECK(document.redo());
  CHECK(document.message() == "done again: a stroke of the mask");
}

TEST_CASE("pictures that were added to an open folder were not seen") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("runner", dir.path());
  Document document(dir.path(), documentOptions());
  REQUIRE(document.go(1));
  document.label({0}, JointClass::kLeg);
  REQUIRE(document.go(0));
  document.label({0}, JointClass::kLeg);
  const DrawingState open = document.state();
  CHECK(document.lookAgain() == 0);

  copyCharacter("alien", dir.path());
  copyCharacter("chef", dir.path());
  CHECK(document.lookAgain() == 1);
  CHECK(document.message() == "2 pictures more in the folder");
  std::vector<std::string> names;
  for (const Item& item : document.items()) names.push_back(item.files.name);
  CHECK(names == std::vector<std::string>{"alien.png", "cap_boy.png", "chef.png", "runner.png"});
  CHECK(document.current() == 1);
  CHECK(document.state() == open);
  CHECK(document.lookAgain() == 0);

  // Steps from before know their drawings.
  CHECK(document.undo());
  CHECK(document.item().files.name == "cap_boy.png");
  CHECK(document.undo());
  CHECK(document.item().files.name == "runner.png");
  CHECK(document.item().classes.done == 0);
  REQUIRE(document.go(0));
  CHECK(document.item().files.name == "alien.png");
  CHECK(document.image().width > 0);
}

TEST_CASE(
    "a folder's drawings are looked through: joints are found unasked, accepted, and finished next time") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("runner", dir.path());
  const auto hand = static_cast<size_t>(loadTemplate("biped").find("left_hand"));
  Eigen::Vector2d placed;
  {
    Document document(dir.path(), documentOptions());
    CHECK(document.subject() == Subject::kJoints);
    CHECK(document.item().joints.parts == 0);
    REQUIRE(document.wantsJoints());
    document.findJoints();
    CHECK_FALSE(document.wantsJoints());
    CHECK(document.rigged());
    CHECK_FALSE(document.canUndo());
    CHECK_FALSE(fs::exists(document.item().files.labels));  // who only looks leaves nothing behind
    CHECK(document.item().joints.parts == 14);
    CHECK(document.item().joints.done == 0);

    document.moveJoint(int(hand), document.state().joints[hand]->image + Eigen::Vector2d(5, 0));
    placed = document.state().joints[hand]->image;
    CHECK(document.item().joints.done == 1);
    document.acceptJoints();
    CHECK(document.item().joints.isWhole());
    CHECK(document.undo());
    CHECK(document.item().joints.done == 1);
    CHECK(document.redo());
  }
  Document document(dir.path(), documentOptions());
  CHECK(document.items()[0].joints.isWhole());
  CHECK(document.current() == 1);
  REQUIRE(document.go(0));
  CHECK_FALSE(document.wantsJoints());
  CHECK(document.state().joints[hand]->image == placed);
  // Middles are no one's decision: they go on following.
  CHECK(document.state().joints[size_t(document.bodyPlan().find("pelvis"))]->origin != JointOrigin::kEdited);
}

TEST_CASE("a folder opens where it was left off: at joints, or at the candidates' classes") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("runner", dir.path());
  { Document(dir.path(), documentOptions()).acceptSuggestions(); }
  {
    Document document(dir.path(), documentOptions());
    CHECK(document.subject() == Subject::kClasses);
    CHECK(document.current() == 1);
    document.go(0);
    document.rig();
    document.moveJoint(document.bodyPlan().find("head"), {300, 150});
  }
  const Document document(dir.path(), documentOptions());
  CHECK(document.subject() == Subject::kJoints);
  CHECK(document.current() == 0);
}

TEST_CASE("a folder opened at a picture that cannot be read, not at the first that can be labelled") {
  const TempDir dir;
  writeFile(dir.file("Ada.heic"), "no picture");
  writeFile(dir.file("Ben.png"), "no picture");
  {
    const Document document(dir.path(), documentOptions());
    CHECK(document.current() == 0);
    CHECK(contains(document.item().problem, "Ada.heic"));
  }
  copyCharacter("cap_boy", dir.path());
  copyCharacter("runner", dir.path());
  const Document document(dir.path(), documentOptions());
  CHECK(document.item().files.name == "cap_boy.png");
  CHECK(document.item().problem.empty());
  CHECK(contains(document.items()[0].problem, "Ada.heic"));
}

TEST_CASE("drawings of a folder stand in the order in which people count") {
  const TempDir dir;
  for (const char* name : {"10.png", "9.png", "Ada.png"})
    fs::copy(kCharacters + "cap_boy.png", dir.file(name));
  const Document document(dir.path(), documentOptions());
  std::vector<std::string> names;
  for (const Item& item : document.items()) names.push_back(item.files.name);
  CHECK(names == std::vector<std::string>{"9.png", "10.png", "Ada.png"});
}

TEST_CASE("suggestions: the least sure first, and all at once") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  double last = 0;
  for (int i = 0; i < 10; ++i) {
    const int unsure = document.mostUnsure();
    REQUIRE(unsure >= 0);
    const double certainty = document.figure().certainties[static_cast<size_t>(unsure)];
    CHECK(certainty >= last);
    last = certainty;
    document.label({unsure}, document.figure().suggestions[static_cast<size_t>(unsure)]);
  }
  document.acceptSuggestions();
  CHECK(document.item().classes.isWhole());
  CHECK(document.mostUnsure() == -1);
  for (size_t i = 0; i < document.state().labels.size(); ++i)
    CHECK(document.state().labels[i] == document.figure().suggestions[i]);
}

TEST_CASE("candidates under a brush, in a lasso, at the mouse") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const Document document(dir.path(), documentOptions());
  const auto& centers = document.figure().centers_px;
  const Eigen::Vector2d p = centers[4];
  CHECK(document.candidateAt(p + Eigen::Vector2d(0.1, 0), 3) == 4);
  CHECK(document.candidateAt({-50, -50}, 3) == -1);
  // Away from all centres, but in the largest disc.
  const auto& figure = document.figure();
  const auto largest = static_cast<size_t>(figure.candidates.kept.front());
  const double radius_px = figure.candidates.maxima[largest].radius / figure.silhouette.grid.scale;
  const Eigen::Vector2d inside = centers[largest] + Eigen::Vector2d(0, -0.6 * radius_px);
  CHECK(document.candidateAt(inside, 0.1) == static_cast<int>(largest));
  const auto near = document.candidatesNear(p, 40);
  CHECK(std::find(near.begin(), near.end(), 4) != near.end());
  for (size_t i = 0; i < centers.size(); ++i)
    CHECK(((centers[i] - p).norm() <= 40) == (std::find(near.begin(), near.end(), int(i)) != near.end()));
  CHECK(document.candidatesInside({{-1, -1}, {601, -1}, {601, 601}, {-1, 601}}).size() == centers.size());
  CHECK(document.candidatesInside({{-1, -1}, {300, -1}, {300, 601}, {-1, 601}}).size() < centers.size());
  CHECK(document.candidatesInside({}).empty());
}

TEST_CASE("a joint that is dragged is edited, stays in the picture, and takes its midpoint along") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.rig();
  REQUIRE(document.rigged());
  const SkeletonTemplate& plan = document.bodyPlan();
  const auto joint = [&](const char* name) { return *document.state().joints[size_t(plan.find(name))]; };
  document.moveJoint(plan.find("left_shoulder"), {900, -20});
  CHECK_FALSE(document.rigged());
  CHECK(joint("left_shoulder").image == Eigen::Vector2d(599, 0));
  CHECK(joint("left_shoulder").origin == JointOrigin::kEdited);
  CHECK(joint("neck").origin == JointOrigin::kDerived);
  CHECK(joint("neck").image == (joint("left_shoulder").image + joint("right_shoulder").image) / 2);

  // Rigging keeps what a person has placed, and finds the rest anew.
  document.rig();
  CHECK(joint("left_shoulder").image == Eigen::Vector2d(599, 0));
  CHECK(document.rigged()->recognition.skeleton.joints[size_t(plan.find("left_shoulder"))].origin ==
        JointOrigin::kEdited);
}

TEST_CASE("a joint of the trunk that was moved did not count as placed") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.rig();
  const int parts = document.item().joints.parts;
  REQUIRE(document.item().joints.done == 0);
  document.moveJoint(document.bodyPlan().find("neck"), {300, 250});
  CHECK(document.item().joints.done == 1);
  CHECK(document.item().joints.parts == parts + 1);
  document.acceptJoints();
  CHECK(document.item().joints.done == parts + 1);
}

TEST_CASE("a model was taken for the one that was shown before, at whose address it lay") {
  LastShown shown;
  for (int i = 0; i < 20; ++i) {
    const auto model = std::make_shared<const RiggedDrawing>();
    CHECK(shown.isAnother(model));
    CHECK_FALSE(shown.isAnother(model));
  }
  const TempDir dir;
  for (const char* name : {"cap_boy", "box_robot"}) copyCharacter(name, dir.path());
  Document document(dir.path(), documentOptions());
  for (const int drawing : {0, 1, 0, 1}) {
    REQUIRE(document.go(drawing));
    document.rig();
    CHECK(shown.isAnother(document.rigged()));
  }
}

TEST_CASE("candidates follow the mask, labels stay where the figure stays") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  Document document(dir.path(), documentOptions());
  document.acceptSuggestions();
  const size_t before = document.figure().centers_px.size();
  const auto figure_pixels = (document.figure().silhouette.mask != 0).count();

  document.beginStep();
  for (int y = 60; y < 160; y += 5) document.paintMask({560, y}, {590, y}, 8, true);
  document.paintMask({560, 100}, {300, 100}, 8, true);  // a flag on a pole
  document.endStep();
  CHECK((document.figure().silhouette.mask != 0).count() > figure_pixels + 1000);
  CHECK(document.state().labels.size() == document.figure().centers_px.size());
  CHECK(document.figure().centers_px.size() != before);
  CHECK(document.item().classes.done > 0.7 * static_cast<double>(before));
  const LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  REQUIRE(labels.mask);
  CHECK(labels.mask->file == "cap_boy.mask.png");
  CHECK(findProblems(dir.file("cap_boy.labels.json")).empty());

  CHECK(document.undo());
  CHECK(document.item().classes.isWhole());
  CHECK_FALSE(fs::exists(dir.file("cap_boy.mask.png")));
}

TEST_CASE("a mask that would show no figure is refused") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  const DrawingState before = document.state();
  document.paintMask({0, 300}, {600, 300}, 900, false);
  CHECK(document.state() == before);
  CHECK(contains(document.message(), "no figure"));
  CHECK_FALSE(document.canUndo());
}

TEST_CASE("a figure that is called right is kept as its mask, and skel-infer no longer asks to look at it") {
  const TempDir dir;
  fs::copy(SKEL_SOURCE_DIR "/datasets/unseen/characters/kd_tadpole_papa.png", dir.file("papa.png"));
  const auto asks = [&] {
    const ToolRun run = runTool("cd '" + dir.path() + "' && skel-infer papa.png --formats json");
    REQUIRE(run.exit_code == 0);
    return contains(run.err, "look at the mask");
  };
  REQUIRE(asks());
  Document document(dir.path(), documentOptions());
  const Plane8 found = document.figure().silhouette.mask;
  document.acceptMask();
  CHECK(document.message() == "the figure: right as it is");
  CHECK(document.saveProblem().empty());
  CHECK(document.item().has_shape);
  CHECK((readMask(dir.file("papa.mask.png")) == found).all());
  CHECK_FALSE(asks());
  document.undo();
  CHECK_FALSE(fs::exists(dir.file("papa.mask.png")));
  CHECK(asks());
}

TEST_CASE("a mask that lay there before is called right by a label file, and stays") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string mask = readFile(dir.file("cap_boy.mask.png"));
  Document document(dir.path(), documentOptions());
  document.acceptMask();
  CHECK_FALSE(document.canUndo());
  CHECK(readLabelFile(dir.file("cap_boy.labels.json")).mask->sha256 == sha256(mask));
  CHECK(readFile(dir.file("cap_boy.mask.png")) == mask);
}

TEST_CASE("a mended mask that lay there before comes back byte by byte") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string original = readFile(dir.file("cap_boy.mask.png"));
  Document document(dir.path(), documentOptions());
  document.paintMask({300, 60}, {300, 20}, 12, true);
  CHECK(readFile(dir.file("cap_boy.mask.png")) != original);
  document.undo();
  CHECK(readFile(dir.file("cap_boy.mask.png")) == original);
}

TEST_CASE("a mask behind a link is written where it lies, and keeps its mode") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string mask = dir.file("cap_boy.mask.png"), real = dir.file("masks/cap_boy.png");
  fs::create_directory(dir.file("masks"));
  fs::rename(mask, real);
  fs::create_symlink("masks/cap_boy.png", mask);
  fs::permissions(real, fs::perms::owner_read | fs::perms::owner_write);
  const std::string original = readFile(real);
  Document document(dir.path(), documentOptions());
  document.paintMask({300, 60}, {300, 20}, 12, true);
  CHECK(document.saveProblem() == "");
  CHECK(fs::is_symlink(mask));
  CHECK(readFile(real) != original);
  CHECK(fs::status(real).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK_FALSE(fs::exists(mask + ".next"));
}

TEST_CASE("limbs painted by hand are rigged with, on the disk at once, found by a new document, and undone") {
  const TempDir dir;
  copyCharacter("boss_crossed", dir.path());
  const std::string file = dir.file("boss_crossed.limbs.png");
  {
    Document document(dir.path(), documentOptions());
    document.rig();
    REQUIRE(document.layers());
    const auto body = document.bodyPlan().find("body");
    const Eigen::Vector2d middle = document.state().joints[size_t(body)]->image;
    document.paintLayer(middle, middle + Eigen::Vector2d(40, 0), 12, limbBrush(2));
    CHECK(fs::exists(file));
    CHECK(contains(document.message(), "left arm"));
    CHECK(int(document.layers()->limb(int(middle.y()), int(middle.x()) + 20)) == 2);
    CHECK_FALSE(document.rigged());
    document.rig();
    REQUIRE(document.rigged());
    CHECK((document.rigged()->layers.limb == document.state().layers->limb).all());
    // Outside of the figure there is nothing to paint.
    document.paintLayer({1, 1}, {2, 2}, 5, limbBrush(2));
    CHECK(int(document.layers()->limb(1, 1)) == 0);
  }
  Document document(dir.path(), documentOptions());
  REQUIRE(document.state().layers);
  CHECK((document.state().layers->limb == 2).count() > 500);
  document.forgetLayers();
  CHECK_FALSE(fs::exists(file));
  document.undo();
  CHECK(fs::exists(file));
}

TEST_CASE("limbs that are found stay where painting begins anew, and looking for them moves no joint") {
  const TempDir dir;
  copyCharacter("box_robot", dir.path());
  Document document(dir.path(), documentOptions());
  const DrawingState before = document.state();
  document.findLimbs();
  REQUIRE(document.layers());
  CHECK_FALSE(document.layers()->any());  // in one piece, until somebody cuts it
  const Plane8 found = document.layers()->part;
  REQUIRE(found.size() > 0);
  CHECK(document.state() == before);
  CHECK_FALSE(document.canUndo());
  CHECK_FALSE(fs::exists(dir.file("box_robot.labels.json")));
  document.paintLayer({300, 300}, {310, 300}, 5, limbBrush(2));
  document.undo();
  document.paintLayer({300, 320}, {310, 320}, 5, limbBrush(2));
  const Plane8& painted = document.state().layers->part;
  CHECK((painted != found).count() < 300);
  const std::uint8_t right_arm = std::uint8_t(limbPart(0));
  CHECK((painted == right_arm).count() == (found == right_arm).count());
}

TEST_CASE("an arm that lies on the body is cut out in one step, and laid back in another") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  document.findLimbs();
  REQUIRE(document.layers());
  CHECK(document.layers()->at_rest == std::vector<int>{1});
  const auto arm = (document.layers()->part == std::uint8_t(limbPart(0))).count();
  REQUIRE(arm > 500);
  document.cutLimb(1);
  REQUIRE(document.state().layers);
  CHECK((document.layers()->limb == std::uint8_t(1)).count() == arm);
  CHECK(contains(document.message(), "right arm: before the body, cut out"));
  document.rig();
  REQUIRE(document.rigged());
  CHECK(document.rigged()->layers.at_rest.empty());
  CHECK(document.rigged()->layers.hidden.empty());
  document.cutLimb(1);
  CHECK_FALSE(document.layers()->any());
  CHECK((document.layers()->part == std::uint8_t(limbPart(0))).count() == arm);
  document.rig();
  REQUIRE(document.rigged());
  CHECK(document.rigged()->layers.at_rest == std::vector<int>{1});
  document.undo();
  CHECK((document.layers()->limb == std::uint8_t(1)).count() == arm);
}

namespace {

// How many pixels of the two pictures differ outside of a disc.
int differences(const Image& a, const Image& b, const Eigen::Vector2d& middle_px, double radius_px) {
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if ((Eigen::Vector2d(x, y) - middle_px).norm() > radius_px)
        count += !std::equal(a.pixel(x, y), a.pixel(x, y) + 4, b.pixel(x, y));
  return count;
}

}  // namespace

TEST_CASE(
    "one stroke on a limb keeps what was painted of skirt, hair, cape, things and limbs grown together") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  // Rows of every colour of docs/formats.md, opaque and translucent.
  const Plane8 mask = readMask(dir.file("cap_boy.mask.png"));
  LayerMap map;
  map.limb = map.part = Plane8::Zero(mask.rows(), mask.cols());
  for (int y = 0; y < int(mask.rows()); ++y) {
    const int part = y / 12 % kPartCount;
    map.part.row(y).setConstant(std::uint8_t(part));
    const bool is_limb = part >= int(Part::kRightArm) && part <= int(Part::kLeftLeg);
    if (is_limb && y / 12 / kPartCount % 2 == 0)
      map.limb.row(y).setConstant(std::uint8_t(part - int(Part::kRightArm) + 1));
  }
  const std::string file = dir.file("cap_boy.limbs.png");
  writeFile(file, encodePng(layerPicture(map, mask)));
  const Image before = readImage(file);
  {
    Document document(dir.path(), documentOptions());
    REQUIRE(document.state().layers);
    document.paintLayer({300, 300}, {300, 300}, 10, limbBrush(2));
  }
  const Image after = readImage(file);
  CHECK(differences(before, after, {300, 300}, 10) == 0);
  const std::array<std::uint8_t, 4> arm = {50, 110, 230, 255};
  CHECK(std::equal(arm.begin(), arm.end(), after.pixel(300, 300)));
}

TEST_CASE("one stroke on what was found keeps the skirt and limbs that are one with the body") {
  const TempDir dir;
  copyCharacter("fashion_skirt", dir.path());
  Document document(dir.path(), documentOptions());
  document.findLimbs();
  REQUIRE(document.layers());
  const Plane8& mask = document.figure().silhouette.mask;
  const Image found = layerPicture(*document.layers(), mask);
  REQUIRE((document.layers()->part == std::uint8_t(Part::kSkirt)).count() > 500);
  const auto grownTogether = [](const Image& picture) { return (picture.rgba.col(3) == 170).count(); };
  REQUIRE(grownTogether(found) > 500);
  const Eigen::Vector2d middle(300, 200);
  REQUIRE(mask(200, 300) != 0);
  document.paintLayer(middle, middle, 8, limbBrush(1));
  CHECK(differences(found, readImage(dir.file("fashion_skirt.limbs.png")), middle, 8) == 0);
}

TEST_CASE(
    "every part of the figure is painted by a brush of its own, and what is painted body is grey again") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), documentOptions());
  const std::vector<LayerBrush> brushes = layerBrushes(document.bodyPlan());
  REQUIRE(brushes.size() == 9);
  const auto colorAt = [&] {
    const Image picture = readImage(dir.file("cap_boy.limbs.png"));
    return std::array{picture.pixel(300, 300)[0], picture.pixel(300, 300)[1], picture.pixel(300, 300)[2]};
  };
  for (std::size_t b = 1; b < brushes.size(); ++b) {
    document.paintLayer({300, 300}, {310, 300}, 6, brushes[b]);
    CHECK(colorAt() == brushColor(brushes[b]));
    CHECK(contains(document.message(), brushName(brushes[b], document.bodyPlan())));
  }
  const DrawingState thing = document.state();
  document.paintLayer({300, 300}, {310, 300}, 6, limbBrush(0));
  CHECK(colorAt() == layerColor(0));
  CHECK_FALSE(document.state() == thing);
  document.undo();
  CHECK(colorAt() == partColor(Part::kThing));
}

TEST_CASE("a click takes an area of one colour off the mask, up to the next line, and puts it back") {
  const TempDir dir;
  Image image = readImage(kCharacters + "box_robot.png");
  // A disc that reaches out from behind the figure.
  const auto inDisc = [](int x, int y) { return (x - 420) * (x - 420) + (y - 200) * (y - 200) < 130 * 130; };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (std::uint8_t* p = image.pixel(x, y); p[3] == 0 && inDisc(x, y)) {
        const std::array<std::uint8_t, 4> orange = {250, std::uint8_t(150 + (x + y) % 9), 20, 255};
        std::copy(orange.begin(), orange.end(), p);
      }
  writeFile(dir.file("robot.png"), encodePng(image));
  Document document(dir.file("robot.png"), documentOptions());
  const Plane8 before = document.figure().silhouette.mask;
  const Eigen::Vector2d on_disc(500, 130), off(20, 20);
  REQUIRE(image.pixel(500, 130)[0] == 250);
  REQUIRE(before(130, 500) != 0);
  document.paintMaskArea(on_disc, false);
  const Plane8 erased = document.figure().silhouette.mask;
  CHECK(erased(130, 500) == 0);
  const Plane8 robot = silhouetteOf(kCharacters + "box_robot.png", std::nullopt).mask;
  CHECK(((erased != 0) != (robot != 0)).count() < .01 * double((robot != 0).count()));
  CHECK(contains(document.message(), "erased from the figure"));
  document.paintMaskArea(on_disc, true);
  CHECK(document.figure().silhouette.mask(130, 500) != 0);
  document.undo();
  document.undo();
  CHECK((document.figure().silhouette.mask == before).all());
  document.paintMaskArea({-5, 3}, false);
  CHECK_FALSE(fs::exists(dir.file("robot.mask.png")));
}

TEST_CASE("each figure of a picture has a mask and painted limbs of its own") {
  const TempDir dir;
  const Image one = readImage(kCharacters + "box_robot.png");
  Image page(1300, 600);
  page.rgba.setZero();
  for (int y = 0; y < 600; ++y)
    for (int x = 0; x < 600; ++x)
      for (const int left : {0, 700}) std::copy_n(one.pixel(x, y), 4, page.pixel(x + left, y));
  writeFile(dir.file("page.png"), encodePng(page));
  SkeletonFile file;
  file.image_file = "page.png";
  file.image_width = 1300;
  file.image_height = 600;
  file.figure.number = 2;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {850, 80}, {1150, 540});
  writeFile(dir.file("page-2.skeleton.json"), formatSkeletonFile(file));
  Document document(dir.file("page-2.skeleton.json"), documentOptions());
  const Plane8& mask = document.figure().silhouette.mask;
  REQUIRE((mask.leftCols(650) != 0).any() != (mask.rightCols(650) != 0).any());
  const int left = (mask.rightCols(650) != 0).any() ? 700 : 0;
  document.paintLayer({left + 300, 300}, {left + 310, 300}, 5, limbBrush(2));
  CHECK(fs::exists(dir.file("page-2.limbs.png")));
  CHECK_FALSE(fs::exists(dir.file("page.limbs.png")));
  // What was said of its mask became the mask of the first figure.
  document.paintMask({left + 300, 300}, {left + 310, 300}, 5, false);
  REQUIRE(fs::exists(dir.file("page-2.mask.png")));
  CHECK_FALSE(fs::exists(dir.file("page.mask.png")));
  CHECK_FALSE(fs::exists(dir.file("page.labels.json")));
  const Plane8 mended = readMask(dir.file("page-2.mask.png"));
  CHECK(mended(300, left + 305) == 0);
  CHECK((mended.middleCols(650 - left / 700 * 650, 650) != 0).count() == 0);
  const SkeletonFile saved = readSkeletonFile(dir.file("page-2.skeleton.json"), loadTemplate("biped"));
  CHECK(saved.figure.number == 2);
  REQUIRE(saved.mask);
  CHECK(saved.mask->file == "page-2.mask.png");
  Document again(dir.file("page-2.skeleton.json"), documentOptions());
  CHECK((again.figure().silhouette.mask == mended).all());
  again.label({0}, JointClass::kHead);
  CHECK(again.message() == "classes are of the first figure of a picture, this is figure 2");

  // They would be those of another drawing.
  writeFile(dir.file("page-2.png"), encodePng(page));
  again.paintMask({left + 320, 300}, {left + 330, 300}, 5, false);
  CHECK(again.message() ==
        "mask and limbs of figure 2 have the name of page-2.png's: give that another name");
  CHECK((readMask(dir.file("page-2.mask.png")) == mended).all());
}

TEST_CASE("a layer map that cannot be read is not written over") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::copy_file(dir.file("cap_boy.png"), dir.file("cap_boy.limbs.png"));
  const std::string before = readFile(dir.file("cap_boy.limbs.png"));
  Document document(dir.path(), documentOptions());
  CHECK(contains(document.item().problem, "which is no limb's"));
  document.paintLayer({300, 300}, {320, 300}, 20, limbBrush(1));
  CHECK(readFile(dir.file("cap_boy.limbs.png")) == before);
}

TEST_CASE("a step in the window overwrote what a script had written into the label file meanwhile") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  Document document(dir.path(), documentOptions());
  const int head = document.bodyPlan().find("head"), left_hand = document.bodyPlan().find("left_hand");
  const std::string path = dir.file("cap_boy.labels.json");
  document.moveJoint(head, {300, 150});
  document.label({0}, JointClass::kLeg);
  LabelFile theirs = readLabelFile(path);
  const auto placeOf = [&](const char* name) {
    for (const auto& [joint, place] : readLabelFile(path).joints)
      if (joint == name && place) return place->x();
    return -1.0;
  };
  std::erase_if(theirs.joints, [](const auto& joint) { return joint.first == "left_hand"; });
  std::erase(theirs.recognized, "left_hand");
  theirs.joints.emplace_back("left_hand", Eigen::Vector2d(430, 300));
  theirs.labels[1] = JointClass::kHand;
  writeLabelFile(path, theirs);
  SECTION("steps are made on what it wrote, and undone without it") {
    document.moveJoint(head, {310, 150});
    CHECK(document.message() ==
          "head placed by hand; cap_boy.labels.json was changed elsewhere and is read anew");
    CHECK(placeOf("head") == 310);
    CHECK(placeOf("left_hand") == 430);
    document.label({2}, JointClass::kBody);
    CHECK(readLabelFile(path).labels[0] == JointClass::kLeg);
    CHECK(readLabelFile(path).labels[1] == JointClass::kHand);
    CHECK(document.undo());
    CHECK(document.undo());
    CHECK(placeOf("head") == 300);
    CHECK(placeOf("left_hand") == 430);
    CHECK_FALSE(document.undo());
    CHECK(document.saveProblem().empty());
  }
  SECTION("undoing leaves it alone") {
    CHECK_FALSE(document.undo());
    CHECK(document.state().joints[static_cast<size_t>(left_hand)]->image.x() == 430);
    CHECK(placeOf("left_hand") == 430);
  }
  SECTION("what cannot be read is not written over") {
    writeFile(path, "half a fi");
    document.moveJoint(head, {310, 150});
    CHECK(readFile(path) == "half a fi");
    CHECK(document.saveProblem().find("cap_boy.labels.json") != std::string::npos);
    writeLabelFile(path, theirs);
    document.moveJoint(head, {320, 150});
    CHECK(document.saveProblem().empty());
    CHECK(placeOf("head") == 320);
    CHECK(placeOf("left_hand") == 430);
  }
}

TEST_CASE("a joint that is dragged in the window is seen in the model, and no other joint moves") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.file("cap_boy.png"), documentOptions());
  document.rigAsItIs();
  CHECK_FALSE(document.rigged());  // no joint is known yet
  document.rig();
  REQUIRE(document.rigged());
  const auto hand = static_cast<size_t>(document.bodyPlan().find("left_hand"));
  const DrawingJoints before = document.state().joints;
  document.moveJoint(static_cast<int>(hand), before[hand]->image + Eigen::Vector2d(-30, 20));
  const DrawingJoints moved = document.state().joints;
  CHECK_FALSE(document.rigged());
  document.rigAsItIs();
  REQUIRE(document.rigged());
  CHECK(document.state().joints == moved);
  const Skeleton& skeleton = document.rigged()->recognition.skeleton;
  for (size_t j = 0; j < moved.size(); ++j) {
    const TemplateJoint& joint = document.bodyPlan().joints[j];
    if (joint.derived) continue;
    const Eigen::Vector2d shown = skeleton.joints[static_cast<size_t>(skeleton.index(joint.name))].image;
    CHECK((shown - moved[j]->image).norm() < 0.01);
    CHECK((j == hand || moved[j]->image == before[j]->image));
  }
  REQUIRE(document.undo());
  CHECK(document.state().joints == before);
}

TEST_CASE("what the last run was unsure of is known of a picture, not of one that took its name since") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  copyCharacter("runner", dir.path(), false);
  SkeletonFile file;
  file.image_file = "../cap_boy.png";
  file.image_sha256 = sha256(readFile(dir.file("cap_boy.png")));
  file.image_width = file.image_height = 600;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {150, 50}, {450, 550});
  file.warnings = {"some joints may be wrong, look at them"};
  writeFile(dir.file("out/cap_boy.skeleton.json"), formatSkeletonFile(file));
  Document document(dir.path(), documentOptions());
  REQUIRE(document.items().size() == 2);
  CHECK(document.doubts(0) == file.warnings);
  CHECK(document.doubts(1).empty());
  document.moveJoint(document.bodyPlan().find("head"), {310, 150});
  CHECK(document.doubts(document.current()).empty());
  REQUIRE(document.undo());
  writeFile(dir.file("cap_boy.png"), readFile(dir.file("runner.png")));
  document.forgetDoubts();
  CHECK(document.doubts(0).empty());
}

TEST_CASE("a step in the window overwrote what a script had written into the skeleton file meanwhile") {
  const TempDir dir;
  fs::copy(kCharacters + "cap_boy.png", dir.file("cap_boy.png"));
  SkeletonFile file;
  file.image_file = "cap_boy.png";
  file.image_width = file.image_height = 600;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {150, 50}, {450, 550});
  const std::string path = dir.file("cap_boy.skeleton.json");
  writeFile(path, formatSkeletonFile(file));
  Document document(path, documentOptions());
  Joint& hand = file.skeleton.joints[static_cast<size_t>(file.skeleton.index("left_hand"))];
  hand.origin = JointOrigin::kEdited;
  hand.image = {400, 300};
  writeFile(path, formatSkeletonFile(file));
  document.moveJoint(document.bodyPlan().find("head"), {310, 150});
  const Skeleton saved = readSkeletonFile(path, loadTemplate("biped")).skeleton;
  CHECK(saved.joints[static_cast<size_t>(saved.index("head"))].image.x() == 310);
  CHECK(saved.joints[static_cast<size_t>(saved.index("left_hand"))].image.x() == 400);
}

TEST_CASE("a step in the window overwrote what a script had written into the motion file meanwhile") {
  const TempDir dir;
  const std::string path = motionOfTwo(dir);
  const SkeletonTemplate plan = loadTemplate("biped");
  const auto head = static_cast<size_t>(plan.find("head"));
  Document document(path, documentOptions());
  REQUIRE(document.go(0));
  MotionFile theirs = readMotionFile(path, plan);
  theirs.frames[1].joints[head] = PlacedJoint{{200, 100}, 1, JointOrigin::kEdited};
  writeFile(path, formatMotionFile(theirs, plan));
  document.moveJoint(int(head), {310, 150});
  const MotionFile saved = readMotionFile(path, plan);
  CHECK(saved.frames[0].joints[head]->image.x() == 310);
  REQUIRE(saved.frames[1].joints[head]);
  CHECK(saved.frames[1].joints[head]->image.x() == 200);
}

TEST_CASE("a mask that was painted elsewhere meanwhile was overwritten by a step in the window") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  Document document(dir.path(), documentOptions());
  document.acceptMask();
  document.moveJoint(document.bodyPlan().find("head"), {300, 150});
  const std::string mask = dir.file("cap_boy.mask.png");
  Plane8 theirs = readMask(mask);
  theirs.topLeftCorner(40, 40) = 255;
  theirs.block(0, 0, 300, 4) = 255;
  writeFile(mask, encodePng(theirs));
  const std::string written = readFile(mask);
  document.moveJoint(document.bodyPlan().find("head"), {310, 150});
  CHECK(readFile(mask) == written);
  CHECK(readLabelFile(dir.file("cap_boy.labels.json")).mask->sha256 == sha256(written));
}

TEST_CASE("a skeleton file: joints are edited in it, and no label file comes up") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const SkeletonTemplate plan = loadTemplate("biped");
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.missing = {"head", "left_hand"};
  const std::string path = dir.file("cap_boy.skeleton.json");
  writeFile(path, formatSkeletonFile(file));

  Document document(path, documentOptions());
  document.moveJoint(plan.find("head"), {300, 100});
  const SkeletonFile saved = readSkeletonFile(path, plan);
  CHECK(saved.skeleton.joints[size_t(saved.skeleton.index("head"))].origin == JointOrigin::kEdited);
  CHECK(saved.skeleton.joints[size_t(saved.skeleton.index("head"))].image == Eigen::Vector2d(300, 100));
  CHECK(saved.missing == std::vector<std::string>{"left_hand"});
  CHECK_FALSE(fs::exists(dir.file("cap_boy.labels.json")));
  document.undo();
  CHECK_FALSE(hasEditedJoint(path));

  document.label({0}, JointClass::kBody);
  CHECK(fs::exists(dir.file("cap_boy.labels.json")));
}

TEST_CASE("a folder began without the joints that were placed in a skeleton file beside the drawing") {
  const TempDir dir;
  for (const char* name : {"Ada.png", "Rosa.png"}) fs::copy(kCharacters + "cap_boy.png", dir.file(name));
  REQUIRE(runTool("cd '" + dir.path() + "' && skel-infer . -o . --formats json").exit_code == 0);
  const int hand = loadTemplate("biped").find("left_hand");
  const std::string path = dir.file("Rosa.skeleton.json");
  const auto mend = [&](const Eigen::Vector2d& place) {
    Document(path, documentOptions()).moveJoint(hand, place);
  };
  const auto shown = [&](const Document& document) { return document.state().joints[size_t(hand)]; };
  mend({420, 300});
  Document document(dir.path(), documentOptions());
  CHECK(document.items()[1].joints.done == 1);
  CHECK(document.items()[1].joints.parts == 14);
  REQUIRE(document.go(1));
  REQUIRE(shown(document));
  CHECK(shown(document)->image == Eigen::Vector2d(420, 300));
  CHECK(shown(document)->origin == JointOrigin::kEdited);
  CHECK(document.item().joints.done == 1);
  CHECK_FALSE(document.wantsJoints());
  CHECK_FALSE(document.canUndo());
  SECTION("all right keeps them") {
    document.acceptJoints();
    CHECK(document.item().joints.isWhole());
    const LabelFile labels = readLabelFile(dir.file("Rosa.labels.json"));
    CHECK(labels.isPlaced("left_hand"));
    for (const auto& [name, place] : labels.joints)
      if (name == "left_hand") CHECK(place == Eigen::Vector2d(420, 300));
  }
  SECTION("of two files that place a joint the one that was written later counts, as for skel-infer") {
    document.moveJoint(hand, {430, 310});
    CHECK(shown(Document(dir.file("Rosa.png"), documentOptions()))->image == Eigen::Vector2d(430, 310));
    mend({410, 290});
    fs::last_write_time(path, fs::last_write_time(dir.file("Rosa.labels.json")) + std::chrono::seconds(1));
    CHECK(shown(Document(dir.file("Rosa.png"), documentOptions()))->image == Eigen::Vector2d(410, 290));
  }
  SECTION("those of a picture before are not taken") {
    fs::copy(kCharacters + "runner.png", dir.file("Rosa.png"), fs::copy_options::overwrite_existing);
    const Document other(dir.file("Rosa.png"), documentOptions());
    CHECK(other.wantsJoints());
    CHECK(other.items()[0].joints.done == 0);
  }
}

TEST_CASE("a skeleton file of another picture is not edited") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const SkeletonTemplate plan = loadTemplate("biped");
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.image_height = 640;
  const std::string path = dir.file("cap_boy.skeleton.json");
  writeFile(path, formatSkeletonFile(file));
  Document document(path, documentOptions());
  CHECK(document.item().problem ==
        path + ": image: has 600x640 px, " + dir.file("cap_boy.png") + " has 600x600; find the joints anew");
  document.moveJoint(3, {10, 10});
  document.rig();
  CHECK_FALSE(document.canUndo());
  CHECK(readFile(path) == formatSkeletonFile(file));
}

TEST_CASE("a skeleton file lies in another folder than its picture") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("pictures"), false);
  const SkeletonTemplate plan = loadTemplate("biped");
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.image_file = "../pictures/cap_boy.png";
  writeFile(dir.file("out/cap_boy.skeleton.json"), formatSkeletonFile(file));
  Document document(dir.file("out/cap_boy.skeleton.json"), documentOptions());
  CHECK(document.item().problem.empty());
  document.paintMask({300, 60}, {300, 20}, 12, true);
  const auto saved = readSkeletonFile(dir.file("out/cap_boy.skeleton.json"), plan);
  REQUIRE(saved.mask);
  CHECK(saved.mask->file == "../pictures/cap_boy.mask.png");
  CHECK(saved.mask->sha256 == sha256(readFile(dir.file("pictures/cap_boy.mask.png"))));
}

TEST_CASE("a skeleton file is edited with the mask that it was made with") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const SkeletonTemplate plan = loadTemplate("biped");
  // Half of the figure.
  Plane8 mask = readMask(dir.file("cap_boy.mask.png"));
  mask.rightCols(300) = 0;
  const std::string path = dir.file("cap_boy.skeleton.json"), given = dir.file("given/half.png");
  writeFile(given, encodePng(mask));
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.mask = SkeletonFile::Mask{"given/half.png", sha256(readFile(given))};
  writeFile(path, formatSkeletonFile(file));

  // The mask beside the drawing is another one, which must not be lost.
  CHECK(contains(Document(path, documentOptions()).item().problem,
                 dir.file("cap_boy.mask.png") + ": is not the mask that " + path + " was made with"));
  fs::remove(dir.file("cap_boy.mask.png"));
  {
    Document document(path, documentOptions());
    REQUIRE(document.state().mask);
    CHECK((document.figure().silhouette.mask.rightCols(300) == 0).all());
    document.moveJoint(plan.find("head"), {250, 100});
    CHECK(readSkeletonFile(path, plan).mask->file == "given/half.png");
    CHECK_FALSE(fs::exists(dir.file("cap_boy.mask.png")));
    CHECK_FALSE(fs::exists(dir.file("cap_boy.labels.json")));
    // Label files speak of masks beside them.
    document.label({0}, JointClass::kBody);
    CHECK(readFile(dir.file("cap_boy.mask.png")) == readFile(given));
    CHECK(findProblems(dir.file("cap_boy.labels.json")).empty());
    document.paintMask({250, 60}, {250, 20}, 12, true);
    CHECK(readSkeletonFile(path, plan).mask->file == "cap_boy.mask.png");
    CHECK(findProblems(dir.file("cap_boy.labels.json")).empty());
    document.undo();
    CHECK(readSkeletonFile(path, plan).mask->file == "given/half.png");
    CHECK(readFile(dir.file("cap_boy.mask.png")) == readFile(given));
  }
  writeFile(given, encodePng(Plane8(Plane8::Constant(600, 600, 255))));
  fs::remove(dir.file("cap_boy.mask.png"));
  fs::remove(dir.file("cap_boy.labels.json"));
  CHECK(contains(Document(path, documentOptions()).message(), "half.png has changed"));
  fs::remove(given);
  CHECK(contains(Document(path, documentOptions()).item().problem, "half.png: cannot be read"));
}

TEST_CASE("a skeleton file lost the outline that its picture alone gives where the mask is painted") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  const SkeletonTemplate plan = loadTemplate("biped");
  const std::string picture = dir.file("cap_boy.png"), path = dir.file("cap_boy.skeleton.json");
  const auto found = [&] { return outlineHash(extractSilhouette(readImage(picture))); };
  const auto saved = [&] { return readSkeletonFile(path, plan); };
  const std::string first = found();
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.image_sha256 = sha256(readFile(picture));
  file.figure.sha256 = first;
  writeFile(path, formatSkeletonFile(file));
  {
    Document document(path, documentOptions());
    document.paintMask({300, 60}, {300, 20}, 12, true);
    CHECK(saved().figure.sha256 != first);
    CHECK(saved().foundOutline() == first);
    document.undo();
    CHECK(saved().figure.sha256 == first);
    document.redo();
  }
  SECTION("a file from before version 5 gets it") {
    file = saved();
    file.figure.found_sha256.clear();
    writeFile(path, formatSkeletonFile(file));
    Document(path, documentOptions()).moveJoint(plan.find("head"), {300, 100});
    CHECK(saved().foundOutline() == first);
  }
  SECTION("of a picture taken again it is that of the picture before, until all is right for the new one") {
    fs::copy(kCharacters + "clown.png", picture, fs::copy_options::overwrite_existing);
    REQUIRE(found() != first);
    Document document(path, documentOptions());
    document.paintMask({300, 60}, {300, 20}, 14, true);
    CHECK(saved().foundOutline() == first);
    document.forgetMask();
    CHECK(saved().foundOutline() == first);
    CHECK_FALSE(saved().mask);
    document.undo();
    document.acceptJoints();
    document.acceptJoints();
    REQUIRE_FALSE(document.isOfEarlierPicture());
    CHECK(saved().mask);
    CHECK(saved().foundOutline() == found());
  }
}

TEST_CASE("a mask that lay there before is not removed when the figure is found in the picture again") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string original = readFile(dir.file("cap_boy.mask.png"));
  Document document(dir.path(), documentOptions());
  document.forgetMask();
  CHECK_FALSE(readLabelFile(dir.file("cap_boy.labels.json")).mask);
  CHECK(readFile(dir.file("cap_boy.mask.png")) == original);
  document.undo();
  CHECK(readLabelFile(dir.file("cap_boy.labels.json")).mask);
  CHECK(findProblems(dir.file("cap_boy.labels.json")).empty());
}

TEST_CASE("a template that the recogniser does not know is said, not thrown") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  DocumentOptions options = documentOptions();
  for (TemplateJoint& joint : options.body_plans[0].joints)
    if (joint.name == "head") joint.name = "beak";
  Document document(dir.path(), std::move(options));
  document.rig();
  CHECK(contains(document.message(), "--recognizer paper"));
  CHECK_FALSE(document.rigged());
  CHECK_FALSE(document.canUndo());
}

TEST_CASE("a motion file: the joints of its frames are moved, undone, done again, and saved at once") {
  const TempDir dir;
  const std::string path = motionOfTwo(dir), before = readFile(path);
  const SkeletonTemplate plan = loadTemplate("biped");
  Document document(path, documentOptions());
  REQUIRE(document.items().size() == 2);
  CHECK(document.items()[0].joints.isWhole());
  CHECK(document.current() == 1);  // the first unfinished
  CHECK(document.item().files.name == "frames/box_robot.png");

  document.rig();
  CHECK(document.rigged());
  CHECK(document.state().joints[0]);
  REQUIRE(document.go(0));
  document.moveJoint(plan.find("left_hand"), {450.5, 320});
  const auto saved = [&](size_t frame, const char* joint) {
    return readMotionFile(path, plan).frames[frame].joints[size_t(plan.find(joint))];
  };
  CHECK(saved(0, "left_hand") == PlacedJoint{{450.5, 320}, 1, JointOrigin::kEdited});
  CHECK(saved(0, "right_hand") == PlacedJoint{{300, 200}, 0.5, JointOrigin::kRecognized});
  CHECK(saved(1, "pelvis"));
  CHECK_FALSE(fs::exists(dir.file("frames/cap_boy.labels.json")));
  CHECK_FALSE(fs::exists(dir.file("frames/box_robot.labels.json")));
  const std::string after = readFile(path);

  CHECK(undoAll(document) == 2);
  CHECK(readFile(path) == before);
  CHECK(document.current() == 1);
  CHECK(document.redo());
  CHECK(document.redo());
  CHECK(readFile(path) == after);
  CHECK(document.current() == 0);
  CHECK(Document(path, documentOptions()).state().joints.size() == 17);
}

TEST_CASE("a frame takes its joints from the frame before, but for those placed by hand") {
  const TempDir dir;
  const std::string path = motionOfTwo(dir);
  Document document(path, documentOptions());
  const auto hand = size_t(document.bodyPlan().find("left_hand"));
  REQUIRE(document.current() == 1);
  document.moveJoint(int(hand), {90, 90});
  document.takeJointsOfFrameBefore();
  CHECK(document.state().joints[hand]->image == Eigen::Vector2d(90, 90));
  CHECK(document.state().joints[0] == PlacedJoint{{300, 200}, 0, JointOrigin::kCompleted});
  CHECK_FALSE(document.item().joints.isWhole());
  CHECK(readMotionFile(path, document.bodyPlan()).frames[1].joints == document.state().joints);
  document.go(0);
  document.takeJointsOfFrameBefore();
  CHECK(contains(document.message(), "first frame"));
  CHECK(document.undo());
  CHECK(document.current() == 1);
  CHECK_FALSE(document.state().joints[0]);
}

TEST_CASE("joints are placed in a frame that shows no figure") {
  const TempDir dir;
  const std::string path = motionOfTwo(dir);
  Image blank(600, 600);
  blank.rgba.setConstant(255);
  writeFile(dir.file("frames/box_robot.png"), encodePng(blank));
  Document document(path, documentOptions());
  REQUIRE(document.current() == 1);
  CHECK_FALSE(document.item().problem.empty());
  document.takeJointsOfFrameBefore();
  document.moveJoint(1, {250, 260});
  CHECK(readMotionFile(path, document.bodyPlan()).frames[1].joints[1]->image == Eigen::Vector2d(250, 260));
  CHECK_FALSE(fs::exists(dir.file("frames/box_robot.labels.json")));
}

TEST_CASE("frames that are missing or of another size say so, and the others can be edited") {
  const TempDir dir;
  const std::string path = motionOfTwo(dir);
  fs::remove(dir.file("frames/box_robot.png"));
  Document document(path, documentOptions());
  CHECK(contains(document.item().problem, "box_robot.png: cannot be read"));
  Image small(60, 60);
  small.rgba.setConstant(255);
  writeFile(dir.file("frames/box_robot.png"), encodePng(small));
  CHECK(document.go(0));
  CHECK(document.item().problem.empty());
  CHECK(document.go(1));
  CHECK(contains(document.item().problem, path + ": frames[1].image: has 600x600 px"));
  const std::string before = readFile(path);
  document.moveJoint(0, {3, 3});
  document.takeJointsOfFrameBefore();
  document.rig();
  CHECK_FALSE(document.canUndo());
  CHECK(readFile(path) == before);
}

TEST_CASE("a label file that cannot be read is not written over") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  writeFile(dir.file("cap_boy.labels.json"), "{}");
  Document document(dir.path(), documentOptions());
  CHECK(contains(document.item().problem, "cap_boy.labels.json: lacks"));
  document.rig();
  document.acceptSuggestions();
  document.paintMask({300, 60}, {300, 20}, 12, true);
  CHECK_FALSE(document.canUndo());
  CHECK(readFile(dir.file("cap_boy.labels.json")) == "{}");
}

TEST_CASE("drawings whose names are not UTF-8 are labelled like any other") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::rename(dir.file("cap_boy.png"), dir.file("h\xe9ros.png"));
  fs::rename(dir.file("cap_boy.mask.png"), dir.file("h\xe9ros.mask.png"));
  {
    Document document(dir.path(), documentOptions());
    document.acceptSuggestions();
    document.paintMask({300, 60}, {300, 20}, 12, true);
    CHECK(document.saveProblem().empty());
  }
  CHECK(findProblems(dir.file("h\xe9ros.labels.json")).empty());
  const Document document(dir.path(), documentOptions());
  CHECK(document.message().empty());
  CHECK(document.state().mask);
}

TEST_CASE("pictures that cannot be labelled say why and do not stop the others") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  writeFile(dir.file("a_broken.png"), "not a picture");
  Image blank(60, 60);
  blank.rgba.setConstant(255);
  writeFile(dir.file("b_blank.png"), encodePng(blank));
  Document document(dir.path(), documentOptions());
  REQUIRE(document.items().size() == 3);
  CHECK(document.go(0));
  CHECK(contains(document.item().problem, "a_broken.png"));
  document.rig();
  document.acceptSuggestions();
  document.labelFromJoints();
  document.paintMask({1, 1}, {2, 2}, 3, true);
  CHECK_FALSE(document.canUndo());
  CHECK(document.go(1));
  CHECK_FALSE(document.item().problem.empty());
  document.moveJoint(0, {3, 3});
  document.rig();
  CHECK_FALSE(document.canUndo());
  CHECK(document.go(2));
  CHECK(document.item().problem.empty());
  CHECK_FALSE(document.go(3));
}

TEST_CASE("a step that cannot be saved is kept, said, and saved later") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  copyCharacter("box_robot", dir.path());
  Document document(dir.path(), documentOptions());
  const std::string labels = document.item().files.labels;
  fs::create_directories(labels + "/in the way");
  document.label({0}, JointClass::kHead);
  CHECK_FALSE(document.saveProblem().empty());
  CHECK(document.item().classes.done == 1);
  CHECK_FALSE(document.go(1));
  fs::remove_all(labels);
  CHECK(document.go(1));
  CHECK(readLabelFile(labels).labels[0] == JointClass::kHead);
}

TEST_CASE("labels are carried over when the picture's candidates are no longer those of the label file") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  {
    Document document(dir.path(), documentOptions());
    document.acceptSuggestions();
  }
  LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  labels.candidates.pop_back();
  labels.labels.pop_back();
  writeLabelFile(dir.file("cap_boy.labels.json"), labels);
  const Document document(dir.path(), documentOptions());
  CHECK(contains(document.message(), "look through the labels"));
  CHECK(document.item().classes.done >= document.item().classes.parts - 1);
}

TEST_CASE(
    "of a picture that has changed since its joints were placed the message says what to do, and that does "
    "it") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  fs::remove(dir.file("cap_boy.joints.json"));
  {
    Document document(dir.path(), documentOptions());
    document.findJoints();
    document.acceptJoints();
  }
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  Document document(dir.path(), documentOptions());
  CHECK(document.message() == "cap_boy.png has changed since it was labelled: Shift R finds its joints anew");
  document.rigAnew();  // Shift R
  const LabelFile labels = readLabelFile(dir.file("cap_boy.labels.json"));
  CHECK(labels.image.sha256 == sha256(readFile(dir.file("cap_boy.png"))));
  CHECK_FALSE(labels.hasPlacedJoint());
}

TEST_CASE("that a picture has changed stays said when its joints have been found in it") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  {
    Document document(dir.path(), documentOptions());
    document.label({0}, JointClass::kBody);
  }
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  Document document(dir.path(), documentOptions());
  const std::string said = "cap_boy.png has changed since it was labelled: look through the labels";
  REQUIRE(document.message() == said);
  REQUIRE(document.wantsJoints());
  document.findJoints();
  CHECK(document.message().starts_with(said + "; rigged"));
}

namespace {

// A photo of which mask, joints and limbs were mended, and another one under its name.
struct TakenAgain {
  TakenAgain() {
    copyCharacter("cap_boy", dir.path(), false);
    fs::remove(dir.file("cap_boy.joints.json"));
    Document document(dir.path(), documentOptions());
    document.findJoints();
    document.paintMask({300, 60}, {300, 20}, 12, true);
    document.paintLayer({300, 300}, {320, 300}, 9, limbBrush(2));
    document.label({0}, JointClass::kBody);
    document.acceptJoints();
    mask = readFile(dir.file("cap_boy.mask.png"));
    limbs = readFile(dir.file("cap_boy.limbs.png"));
    labels = readFile(dir.file("cap_boy.labels.json"));
    take(readFile(kCharacters + "clown.png"));
  }
  void take(const std::string& picture) {
    writeFile(dir.file("cap_boy.png"), picture);
    picture_sha256 = sha256(picture);
  }
  LabelFile saved() const { return readLabelFile(dir.file("cap_boy.labels.json")); }

  TempDir dir;
  std::string mask, limbs, labels, picture_sha256;
};

}  // namespace

TEST_CASE(
    "of a photo taken again Shift R drops mask, joints and limbs of the one before in one step, and says "
    "so") {
  const TakenAgain photo;
  Document document(photo.dir.path(), documentOptions());
  CHECK(document.isOfEarlierPicture());
  CHECK(document.message() ==
        "cap_boy.png has changed since it was labelled: Shift R finds figure and joints anew");
  CHECK_FALSE(document.item().joints.isWhole());
  const DrawingState before = document.state();
  REQUIRE(before.mask);
  REQUIRE(before.layers);

  document.rigAnew();
  CHECK(document.message().starts_with("joints, mask (M), limbs (G) were those of the picture before"));
  CHECK(contains(document.message(), "; rigged"));
  CHECK_FALSE(document.isOfEarlierPicture());
  CHECK_FALSE(document.state().mask);
  CHECK_FALSE(document.state().layers);
  CHECK(document.rigged());
  CHECK(photo.saved().image.sha256 == photo.picture_sha256);
  CHECK_FALSE(photo.saved().mask);
  CHECK_FALSE(photo.saved().hasPlacedJoint());
  CHECK_FALSE(photo.saved().labels[0]);
  // What skel-infer would take up has gone from there, and is not lost.
  CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.mask.png")));
  CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.limbs.png")));
  CHECK(readFile(photo.dir.file("cap_boy.old.mask.png")) == photo.mask);
  CHECK(readFile(photo.dir.file("cap_boy.old.limbs.png")) == photo.limbs);

  CHECK(document.undo());
  CHECK_FALSE(document.canUndo());
  CHECK(document.state() == before);
  CHECK(document.isOfEarlierPicture());
  CHECK(readFile(photo.dir.file("cap_boy.mask.png")) == photo.mask);
  CHECK(readFile(photo.dir.file("cap_boy.labels.json")) == photo.labels);
  CHECK(fs::exists(photo.dir.file("cap_boy.limbs.png")));
  CHECK(document.redo());
  CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.mask.png")));
  document.acceptJoints();
  CHECK(photo.saved().image.sha256 == photo.picture_sha256);
  CHECK(photo.saved().hasPlacedJoint());
  CHECK_FALSE(photo.saved().mask);
}

TEST_CASE(
    "of a photo taken again Shift R drops what was painted on the mask and limbs of the one before, too, and "
    "keeps it aside") {
  TakenAgain photo;
  const auto drops = [&](Document& document) {
    document.paintMask({250, 60}, {250, 20}, 12, true);
    document.paintLayer({300, 320}, {320, 320}, 9, limbBrush(2));
    const std::string painted = readFile(photo.dir.file("cap_boy.mask.png")),
                      limbs = readFile(photo.dir.file("cap_boy.limbs.png"));
    document.rigAnew();
    CHECK(document.saveProblem().empty());
    CHECK_FALSE(document.state().mask);
    CHECK_FALSE(photo.saved().mask);
    CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.mask.png")));
    CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.limbs.png")));
    CHECK(readFile(photo.dir.file("cap_boy.old.mask.png")) == painted);
    CHECK(readFile(photo.dir.file("cap_boy.old.limbs.png")) == limbs);
  };
  SECTION("painted before the window was opened") {
    Document document(photo.dir.path(), documentOptions());
    drops(document);
  }
  SECTION("painted while the window was open") {
    for (const char* name : {"cap_boy.mask.png", "cap_boy.limbs.png", "cap_boy.labels.json"})
      fs::remove(photo.dir.file(name));
    copyCharacter("ninja", photo.dir.path(), false);
    fs::remove(photo.dir.file("ninja.joints.json"));
    photo.take(readFile(kCharacters + "cap_boy.png"));
    Document document(photo.dir.path(), documentOptions());
    document.findJoints();
    document.paintMask({300, 60}, {300, 20}, 12, true);
    document.paintLayer({300, 300}, {320, 300}, 9, limbBrush(2));
    document.acceptJoints();
    document.go(1);
    photo.take(readFile(kCharacters + "clown.png"));
    document.go(0);
    REQUIRE(document.isOfEarlierPicture());
    drops(document);
  }
}

TEST_CASE(
    "of a photo taken again all right is asked twice where a mask of the one before would count for it") {
  const TakenAgain photo;
  Document document(photo.dir.path(), documentOptions());
  SECTION("also in mask") {
    document.acceptMask();
    CHECK(document.isOfEarlierPicture());
    document.acceptMask();
    CHECK_FALSE(document.isOfEarlierPicture());
    return;
  }
  CHECK_FALSE(document.acceptJoints());
  CHECK(document.message().starts_with("of the picture before: mask (M), limbs (G); look, then Enter again"));
  CHECK(document.isOfEarlierPicture());
  CHECK_FALSE(document.canUndo());
  CHECK(readFile(photo.dir.file("cap_boy.labels.json")) == photo.labels);
  SECTION("the second time takes them") {
    CHECK(document.acceptJoints());
    CHECK_FALSE(document.isOfEarlierPicture());
    CHECK(photo.saved().image.sha256 == photo.picture_sha256);
    CHECK(photo.saved().mask->sha256 == sha256(photo.mask));
    CHECK(document.item().joints.isWhole());
    document.undo();
    CHECK(readFile(photo.dir.file("cap_boy.labels.json")) == photo.labels);
  }
  SECTION("other steps are saved, but as those of the photo before") {
    document.moveJoint(document.bodyPlan().find("head"), {250, 100});
    CHECK(contains(document.message(), "the picture has changed since: Shift R"));
    CHECK(photo.saved().image.sha256 != photo.picture_sha256);
    CHECK(Document(photo.dir.path(), documentOptions()).isOfEarlierPicture());
  }
}

TEST_CASE("of a photo taken again without a mask of the one before all right takes its joints at once") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  {
    Document document(dir.path(), documentOptions());
    document.findJoints();
    document.acceptJoints();
  }
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  Document document(dir.path(), documentOptions());
  CHECK(document.acceptJoints());
  CHECK(readLabelFile(dir.file("cap_boy.labels.json")).image.sha256 ==
        sha256(readFile(dir.file("cap_boy.png"))));
}

TEST_CASE("joints of the photo before were said not to be placed, though they were drawn") {
  const TakenAgain photo;
  Document document(photo.dir.path(), documentOptions());
  CHECK(document.item().joints.done == 0);
  CHECK(document.countedJoints() == std::string("for this photo"));
  document.rigAnew();
  CHECK(document.countedJoints() == std::string("joints placed"));
}

TEST_CASE("a photo taken again kept its tick in the list until it was opened") {
  const TempDir dir;
  for (const char* name : {"box_robot", "cap_boy"}) copyCharacter(name, dir.path(), false);
  {
    Document document(dir.path(), documentOptions());
    for (int item : {0, 1}) {
      document.go(item);
      document.findJoints();
      document.acceptJoints();
    }
  }
  const auto ticks = [&] {
    const Document document(dir.path(), documentOptions());
    return std::pair(document.items()[0].joints.isWhole(), document.current());
  };
  CHECK(ticks() == std::pair(true, 0));
  fs::copy(kCharacters + "clown.png", dir.file("box_robot.png"), fs::copy_options::overwrite_existing);
  CHECK(ticks() == std::pair(false, 0));
  fs::copy(kCharacters + "box_robot.png", dir.file("box_robot.png"), fs::copy_options::overwrite_existing);
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  CHECK(ticks() == std::pair(true, 1));
  Document document(dir.path(), documentOptions());
  document.go(0);
  CHECK_FALSE(document.items()[1].joints.isWhole());
}

TEST_CASE("a photo taken again in another size opens without what was mended of the one before") {
  TakenAgain photo;
  const Image clown = readImage(kCharacters + "clown.png");
  Image wide(700, 600);
  wide.rgba.setZero();
  for (int y = 0; y < 600; ++y) std::copy_n(clown.pixel(0, y), 4 * 600, wide.pixel(0, y));
  photo.take(encodePng(wide));
  Document document(photo.dir.path(), documentOptions());
  CHECK(document.item().problem.empty());
  CHECK(contains(document.message(), "another picture, of another size"));
  CHECK_FALSE(document.state().mask);
  REQUIRE(document.wantsJoints());
  document.findJoints();
  CHECK(readFile(photo.dir.file("cap_boy.labels.json")) == photo.labels);  // who only looks changes nothing
  document.acceptJoints();
  CHECK(document.saveProblem().empty());
  CHECK(photo.saved().image.sha256 == photo.picture_sha256);
  CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.mask.png")));
  CHECK_FALSE(fs::exists(photo.dir.file("cap_boy.limbs.png")));
  CHECK(readFile(photo.dir.file("cap_boy.old.mask.png")) == photo.mask);
  CHECK(readFile(photo.dir.file("cap_boy.old.limbs.png")) == photo.limbs);
}

TEST_CASE("a skeleton of a photo taken again is found anew by Shift R and then says which photo it is of") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  const SkeletonTemplate plan = loadTemplate("biped");
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.image_sha256 = sha256(readFile(dir.file("cap_boy.png")));
  for (Joint& joint : file.skeleton.joints) joint.origin = JointOrigin::kEdited;
  const std::string path = dir.file("cap_boy.skeleton.json");
  writeFile(path, formatSkeletonFile(file));
  fs::copy(kCharacters + "clown.png", dir.file("cap_boy.png"), fs::copy_options::overwrite_existing);
  Document document(path, documentOptions());
  CHECK(contains(document.message(), "has changed since it was rigged"));
  document.rigAnew();
  CHECK_FALSE(hasEditedJoint(path));
  CHECK(readSkeletonFile(path, plan).image_sha256 == sha256(readFile(dir.file("cap_boy.png"))));
  document.undo();
  CHECK(hasEditedJoint(path));
  CHECK(readSkeletonFile(path, plan).image_sha256 == file.image_sha256);
}

TEST_CASE("a joint moved in the skeleton of a photo taken again made it that of a figure in other colours") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  const SkeletonTemplate plan = loadTemplate("biped");
  const std::string picture = dir.file("cap_boy.png"), path = dir.file("cap_boy.skeleton.json");
  SkeletonFile file = skeletonOfCapBoy(plan);
  file.image_sha256 = sha256(readFile(picture));
  file.figure.sha256 = outlineHash(extractSilhouette(readImage(picture)));
  writeFile(path, formatSkeletonFile(file));
  fs::copy(kCharacters + "clown.png", picture, fs::copy_options::overwrite_existing);
  Document document(path, documentOptions());
  document.moveJoint(plan.find("head"), {300, 100});
  CHECK(readSkeletonFile(path, plan).figure.sha256 == file.figure.sha256);
  document.acceptJoints();
  CHECK(readSkeletonFile(path, plan).figure.sha256 == outlineHash(extractSilhouette(readImage(picture))));
}

TEST_CASE("folders without pictures and pictures that share a label file are refused") {
  const TempDir dir;
  CHECK_THROWS_AS(Document(dir.path(), documentOptions()), InputError);
  CHECK_THROWS_AS(Document(dir.file("nowhere"), documentOptions()), InputError);
  {
    copyCharacter("cap_boy", dir.file("locked"));
    const LockedFolder locked(dir, "locked");
    CHECK_THROWS_WITH(Document(dir.path(), documentOptions()),
                      dir.file("locked") + ": cannot be read: Permission denied");
  }
  fs::remove_all(dir.file("locked"));
  copyCharacter("cap_boy", dir.path());
  fs::copy(dir.file("cap_boy.png"), dir.file("cap_boy.jpg"));
  CHECK_THROWS_WITH(Document(dir.path(), documentOptions()),
                    dir.file("cap_boy.png") + ": would share its label file with " + dir.file("cap_boy.jpg") +
                        "; rename one of them");
  // Also where another one comes between them.
  fs::copy(dir.file("cap_boy.png"), dir.file("cap_boy.left.png"));
  CHECK_THROWS_WITH(Document(dir.path(), documentOptions()),
                    dir.file("cap_boy.png") + ": would share its label file with " + dir.file("cap_boy.jpg") +
                        "; rename one of them");
}

namespace {

const std::string kHorse = SKEL_SOURCE_DIR "/datasets/unseen/animals/an3_kid_stick_horse.png";

DocumentOptions anyPlan() { return {defaultMlp(), bodyPlans("auto")}; }

}  // namespace

TEST_CASE("an animal among the drawings of a class got a person's skeleton") {
  const TempDir dir;
  fs::copy(kHorse, dir.file("Noah.png"));
  fs::copy(kCharacters + "cap_boy.png", dir.file("cap_boy.png"));
  {
    Document document(dir.path(), anyPlan());
    REQUIRE(document.item().files.name == "cap_boy.png");
    document.findJoints();
    CHECK(document.bodyPlan().name == "biped");
    document.acceptJoints();
    REQUIRE(document.go(1));
    document.findJoints();
    CHECK(document.bodyPlan().name == "quadruped");
    CHECK(document.state().joints.size() == document.bodyPlan().joints.size());
    document.acceptJoints();
    CHECK(document.items()[1].joints.isWhole());
    REQUIRE(document.undo());
    REQUIRE(document.redo());
  }
  CHECK(readLabelFile(dir.file("Noah.labels.json")).isPlaced("left_hind_foot"));
  Document again(dir.path(), anyPlan());
  CHECK(again.items()[0].joints.isWhole());
  CHECK(again.items()[1].joints.isWhole());
  REQUIRE(again.go(1));
  CHECK(again.bodyPlan().name == "quadruped");
  CHECK(runTool("skel-label check '" + dir.path() + "'").out == "no inconsistencies\n");
  const ToolRun run = runTool("cd '" + dir.path() + "' && skel-infer . -o . --formats json");
  CHECK(run.exit_code == 0);
  CHECK(readSkeletonFile(dir.file("Noah.skeleton.json"), loadTemplate("quadruped")).labels);
}

TEST_CASE("who was taken for a person is made an animal in the window, and undo makes it a person again") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  Document document(dir.path(), anyPlan());
  document.findJoints();
  document.acceptJoints();
  const std::string person = readFile(dir.file("cap_boy.labels.json"));
  REQUIRE(document.otherPlan());
  document.takeOtherPlan();
  CHECK(document.bodyPlan().name == "quadruped");
  CHECK(contains(document.message(), "taken for a quadruped: "));
  CHECK(document.item().joints.done == 0);
  const std::string animal = readFile(dir.file("cap_boy.labels.json"));
  CHECK(contains(animal, "left_hind_foot"));
  REQUIRE(document.undo());
  CHECK(document.bodyPlan().name == "biped");
  CHECK(document.item().joints.isWhole());
  CHECK(readFile(dir.file("cap_boy.labels.json")) == person);
  REQUIRE(document.redo());
  CHECK(readFile(dir.file("cap_boy.labels.json")) == animal);
  document.rig();
  CHECK(document.bodyPlan().name == "quadruped");  // as a person has said
  CHECK_FALSE(Document(dir.path(), documentOptions()).otherPlan());
}

TEST_CASE("joints of another body plan than is asked for counted as placed") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  {
    Document document(dir.path(), anyPlan());
    document.findJoints();
    document.acceptJoints();
  }
  Document document(dir.file("cap_boy.png"), {defaultMlp(), bodyPlans("quadruped")});
  CHECK(document.items()[0].joints.parts == 0);
  CHECK(contains(
      document.message(),
      "the label file has a biped's joints, not a quadruped's: not shown, and the next step replaces "
      "them; --template biped, or auto, shows them"));
  CHECK(document.wantsJoints());
}

TEST_CASE("a skeleton file and a motion open by their own body plan") {
  const TempDir dir;
  fs::create_directories(dir.file("frames"));
  fs::copy(kHorse, dir.file("frames/1.png"));
  const ToolRun run = runTool("cd '" + dir.path() +
                              "' && skel-label motion frames && skel-infer frames/1.png --formats json");
  REQUIRE(run.exit_code == 0);
  CHECK(Document(dir.file("out/frames.motion.json"), anyPlan()).bodyPlan().name == "quadruped");
  Document skeleton(dir.file("out/1.skeleton.json"), anyPlan());
  CHECK(skeleton.bodyPlan().name == "quadruped");
  CHECK_FALSE(skeleton.otherPlan());
  skeleton.moveJoint(skeleton.bodyPlan().find("tail"), {100, 100});
  CHECK(hasEditedJoint(dir.file("out/1.skeleton.json")));
}
