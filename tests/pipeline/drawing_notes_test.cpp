// What a person should know of a drawing that was rigged.
#include "libskel/pipeline/drawing_notes.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "libskel/image/read_image.h"
#include "libskel/pipeline/drawn_cut_out.h"
#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("an arm that is drawn in part alone came off the body without a word") {
  RiggedDrawing drawing = [] {
    RigInput input;
    input.image = readImage(SKEL_DATASETS "/characters/cap_boy.png");
    return rigCharacter(std::move(input), {});
  }();
  CHECK(partlyDrawnNotes(drawing).empty());
  const auto place = [&](const char* joint) {
    const Skeleton& skeleton = drawing.recognition.skeleton;
    return Eigen::Vector2i(skeleton.joints[std::size_t(skeleton.index(joint))].image.cast<int>());
  };
  const auto is_arm = [&](const TemplateLimb& limb) {
    return drawing.body_plan.joints[std::size_t(limb.joints[2])].name == "left_hand";
  };
  const auto& limbs = drawing.body_plan.limbs;
  const auto arm = std::uint8_t(1 + (std::find_if(limbs.begin(), limbs.end(), is_arm) - limbs.begin()));
  drawing.layers.limb = Plane8::Zero(drawing.image.height, drawing.image.width);
  drawing.layers.limb.block(place("left_hand").y() - 5, place("left_hand").x() - 5, 10, 10) = arm;
  REQUIRE(partlyDrawnNotes(drawing).size() == 1);
  CHECK_THAT(partlyDrawnNotes(drawing).front(), Catch::Contains("left arm is drawn in part alone"));
}

TEST_CASE("who may look to the other side than it was taken to is named with what says it right") {
  RiggedCharacter character;
  CHECK_FALSE(facingNote(character));
  character.facing = Facing{std::numbers::pi / 4, 1, .95};
  CHECK_FALSE(facingNote(character));
  character.facing->sure = .7;
  REQUIRE(facingNote(character));
  CHECK(noteText({*facingNote(character)}, "in/my hero.png") ==
        "was taken to look right, which is doubtful: --facing 'my hero'=45 says that it does, --facing 'my "
        "hero'=-45 that it looks left, --facing 'my hero'=0 at you");
  CHECK_THAT(noteText({*facingNote(character)}, "FILE"), Catch::Contains("--facing NAME=-45"));
  character.facing = Facing{0, 1, .7};
  CHECK_FALSE(facingNote(character));
  character.facing = Facing::at(-1);  // somebody has said it
  CHECK_FALSE(facingNote(character));
}

TEST_CASE("a barbell broke in two when one of the arms that lift it moved") {
  const auto rig = [](std::optional<NamedPicture> layers) {
    RigInput input;
    input.image = readImage(SKEL_DATASETS "/unseen/characters/bo4_giant_tiny_head_lift.png");
    input.layers = std::move(layers);
    return rigCharacter(std::move(input), {});
  };
  const RiggedDrawing lifter = rig({});
  CHECK(lifter.layers.hands_linked);
  CHECK(lifter.layers.hidden == std::vector<int>{1, 2});
  CHECK_FALSE(lifter.layers.any());
  const std::vector<Note> notes = limbNotes(lifter, {});
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes.front().text, Catch::StartsWith("the hands hold one thing, or each other"));
  // Arms that somebody has painted move by themselves.
  LayerMap painted = lifter.layers;
  painted.limb = Plane8::Zero(painted.part.rows(), painted.part.cols());
  for (const int limb : {1, 2})
    painted.limb =
        (painted.part == std::uint8_t(limbPart(limb - 1))).select(std::uint8_t(limb), painted.limb);
  const RiggedDrawing mended = rig(NamedPicture{layerPicture(painted, lifter.silhouette.mask), "limbs.png"});
  CHECK_FALSE(mended.layers.hands_linked);
  CHECK(mended.layers.hidden.empty());
}

TEST_CASE("who sits with the knees drawn up was torn when the legs were swung") {
  const auto rig = [](const char* file) {
    RigInput input;
    input.image = readImage(std::string(SKEL_DATASETS) + file);
    return rigCharacter(std::move(input), {});
  };
  const RiggedDrawing drawing = rig("/unseen/characters/kf_wash_hug_knees.png");
  const CutOut cut_out = cutOutOf(drawing);
  const Eigen::Quaternionf still = Eigen::Quaternionf::Identity(),
                           out(Eigen::AngleAxisf(1.2f, Eigen::Vector3f::UnitZ()));
  Clip swing;
  swing.tracks = {{"left_hip", {0, .5f, 1}, {still, out, still}},
                  {"right_hip", {0, .5f, 1}, {still, out.inverse(), still}}};
  const auto tornAtMost = [&](const Calm& calm) {
    double torn = 0;
    for (int i = 0; i < 8; ++i)
      torn =
          std::max(torn, tornShare(cut_out, posedSheets(cut_out, flatPoseAt(drawing, swing, i / 7., calm))));
    return torn;
  };
  CHECK(tornAtMost({}) > .05);
  const Calm calm = calmFor(drawing, cut_out, swing);
  CHECK(calm.legs < 1);
  CHECK(calm.torn <= kMuchTorn);
  CHECK(tornAtMost(calm) <= kMuchTorn + .005);
  // One who stands swings them all the way.
  const RiggedDrawing boy = rig("/characters/cap_boy.png");
  const Eigen::Quaternionf little(Eigen::AngleAxisf(.3f, Eigen::Vector3f::UnitZ()));
  swing.tracks[0].rotations[1] = little, swing.tracks[1].rotations[1] = little.inverse();
  CHECK(calmFor(boy, cutOutOf(boy), swing).legs == 1);
}
