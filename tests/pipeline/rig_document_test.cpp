#include "libskel/pipeline/rig_document.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "libskel/animation/clip_library.h"
#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/layers/layer_map.h"
#include "libskel/pipeline/rig_drawing.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

Image drawingCalled(const std::string& name) { return readImage(SKEL_SOURCE_DIR "/datasets/" + name); }

template <class A>
std::string bytesOf(const A& array) {
  return {reinterpret_cast<const char*>(array.data()),
          sizeof(typename A::Scalar) * static_cast<std::size_t>(array.size())};
}

// All that was found out, or what was said instead.
std::vector<std::string> resultOf(const std::function<std::shared_ptr<const RiggedDrawing>()>& rigged) try {
  const auto drawing = rigged();
  const RiggedDrawing& d = *drawing;
  std::vector<std::string> all = {bytesOf(d.image.rgba), bytesOf(d.silhouette.mask),
                                  d.silhouette.reason,   std::to_string(d.silhouette.figure_count),
                                  d.body_plan.name,      std::to_string(d.recognition.confidence)};
  if (!d.found()) return all;
  for (const std::string& bytes :
       {bytesOf(d.features), bytesOf(d.classes), bytesOf(d.layers.limb), bytesOf(d.layers.part),
        bytesOf(Eigen::ArrayXi::Map(d.layers.hidden.data(), Eigen::Index(d.layers.hidden.size())))})
    all.push_back(bytes);
  for (const Joint& joint : d.recognition.skeleton.joints) {
    all.push_back(joint.name + std::string(jointOriginName(joint.origin)) + std::to_string(joint.confidence));
    all.push_back(bytesOf(joint.image) + bytesOf(joint.position));
  }
  all.insert(all.end(), d.recognition.missing.begin(), d.recognition.missing.end());
  all.insert(all.end(), d.recognition.warnings.begin(), d.recognition.warnings.end());
  all.push_back(encodeGlb(d.character, d.clips));
  return all;
} catch (const Error& error) {
  return {error.what()};
}

void paint(Plane8& mask, const Eigen::Vector2d& at, double radius_px, std::uint8_t value) {
  for (Eigen::Index y = 0; y < mask.rows(); ++y)
    for (Eigen::Index x = 0; x < mask.cols(); ++x)
      if ((Eigen::Vector2d(double(x), double(y)) - at).norm() < radius_px) mask(y, x) = value;
}

std::set<std::string> stagesOf(const RiggedDrawing& drawing) {
  std::set<std::string> stages;
  for (const StageTime& time : drawing.times) stages.insert(time.stage);
  return stages;
}

// Some change of what is rigged, or of how.
void edit(Rng& rng, RigDocument& document) {
  RigInput input = document.input();
  RigOptions options = document.options();
  const auto rigged = document.rigged();
  const RiggedDrawing& last = *rigged;
  const auto pick = [&](auto... values) {
    const std::array all{values...};
    return all[rng.below(static_cast<std::uint32_t>(all.size()))];
  };
  switch (rng.below(14)) {
    case 0:
    case 1:
      if (!last.found()) return;
      {
        const Joint joint = last.recognition.skeleton
                                .joints[rng.below(std::uint32_t(last.recognition.skeleton.joints.size()))];
        document.moveJoint(joint.name,
                           joint.image + Eigen::Vector2d(rng.uniform(-30, 30), rng.uniform(-30, 30)));
      }
      return;
    case 2:
    case 3:
      if (!last.found()) return;
      input.mask = last.silhouette.mask;
      paint(*input.mask, last.recognition.skeleton.joints[rng.below(10)].image, rng.uniform(4, 20),
            pick(0, 255));
      document.setMask(std::move(input.mask));
      return;
    case 4:
      document.setMask(std::nullopt);
      return;
    case 5:
      document.setSkeleton(std::nullopt);
      return;
    case 6:
      options.skin_method = pick(SkinMethod::kGeodesic, SkinMethod::kHeat, SkinMethod::kIdw);
      break;
    case 7:
      if (rng.chance(.5))
        options.clips.resize(1);
      else
        options.clips = clipsFor(builtinClips(), options.body_plan);
      break;
    case 8:
      options.layers = !options.layers;
      break;
    case 9:
      options.rest_pose = pick(RestPose::kDrawn, RestPose::kT);
      break;
    case 10:
      if (rng.chance(.5))
        options.back = pick(Back::kSame, Back::kPlain);
      else
        options.height_m = pick(0., 2.);
      break;
    case 11:
      options.recognizer = pick(Recognizer::kTree, Recognizer::kPaper);
      break;
    case 12:
      if (!last.found()) return;
      if (input.layers) {
        input.layers.reset();
      } else if (last.layers.part.size() > 0) {
        LayerMap map = last.layers;
        if (!map.any()) map.limb = Plane8::Zero(map.part.rows(), map.part.cols());
        paint(map.limb, last.recognition.skeleton.joints[rng.below(10)].image, 25, pick(0, 1, 2));
        input.layers = NamedPicture{layerPicture(map, last.silhouette.mask), "limbs.png"};
      }
      document.setInput(std::move(input));
      return;
    case 13:
      input.placed = {{"left_hand", Eigen::Vector2d(rng.uniform(100, 500), rng.uniform(100, 500))}};
      if (rng.chance(.3)) input.placed.clear();
      document.setInput(std::move(input));
      return;
  }
  document.setOptions(std::move(options));
}

}  // namespace

TEST_CASE("after any edits a document has the bytes of a rig made anew") {
  for (const std::string name : {"characters/cap_boy.png", "characters/alien.png"}) {
    Rng rng(name.size(), 0);
    RigDocument document(rigOptions("biped"));
    document.setImage(drawingCalled(name));
    for (int round = 0; round < 12; ++round) {
      std::string said;
      for (std::uint32_t edits = rng.below(3) + 1; edits > 0; --edits) edit(rng, document);
      if (rng.chance(.4)) resultOf([&] { return document.draft(); });
      const auto kept = resultOf([&] { return document.rigged(); });
      const auto made = resultOf([&] {
        return std::make_shared<const RiggedDrawing>(rigCharacter(document.input(), document.options()));
      });
      CAPTURE(name, round);
      REQUIRE(kept == made);
    }
  }
}

TEST_CASE("a change runs the stages that it touches and no others") {
  using Stages = std::set<std::string>;
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  const Stages all = stagesOf(*document.rigged()), always = {"features", "classes", "lift", "clips"};
  const auto ran = [&] {
    Stages only;
    for (const std::string& stage : stagesOf(*document.rigged()))
      if (!always.contains(stage)) only.insert(stage);
    return only;
  };
  CHECK(all.contains("recognition"));
  CHECK(all.contains("mesh"));

  const auto first = document.rigged();
  document.setInput(RigInput(document.input()));
  document.setOptions(RigOptions(document.options()));
  CHECK(document.rigged() == first);

  const Skeleton& skeleton = first->recognition.skeleton;
  const Eigen::Vector2d hand = skeleton.joints[std::size_t(skeleton.index("left_hand"))].image;
  document.moveJoint("left_hand", hand + Eigen::Vector2d(-9, 4));
  CHECK(ran() == Stages{"layers", "pieces", "mesh", "skin", "stretch"});
  document.setSkeleton(std::nullopt);
  CHECK(ran() ==
        Stages{"layers", "pieces", "mesh", "skin", "stretch"});  // what was recognised is known still
  document.setMask(first->silhouette.mask);
  CHECK(ran() == Stages{"silhouette", "even light", "candidates", "recognition", "layers", "pieces", "mesh",
                        "skin", "stretch"});

  RigOptions options = document.options();
  options.clips.resize(1);
  document.setOptions(options);
  CHECK(ran().empty());
  options.rest_pose = RestPose::kT;
  document.setOptions(options);
  CHECK(ran() == Stages{"rest pose", "stretch"});
  options.rest_pose = RestPose::kDrawn;
  options.skin_method = SkinMethod::kIdw;
  document.setOptions(options);
  CHECK(ran() == Stages{"skin", "stretch"});
  LayerMap map = first->layers;
  map.limb = Plane8::Zero(map.part.rows(), map.part.cols());
  document.setLayers(NamedPicture{layerPicture(map, first->silhouette.mask), "limbs.png"});
  CHECK(ran() == Stages{"pieces", "mesh", "skin", "stretch"});
}

TEST_CASE("a draft moves the joints of the model that is there, and leaves the rest to the whole rig") {
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  const RiggedDrawing whole = *document.rigged();
  const int hand = whole.recognition.skeleton.index("left_hand");
  const Eigen::Vector2d there =
      whole.recognition.skeleton.joints[std::size_t(hand)].image + Eigen::Vector2d(-20, 10);
  document.moveJoint("left_hand", there);
  const RiggedDrawing draft = *document.draft();
  CHECK(draft.character.mesh.vertices == whole.character.mesh.vertices);
  CHECK(draft.clips.size() == whole.clips.size());
  CHECK(draft.recognition.skeleton.joints[std::size_t(hand)].image == there);
  CHECK(draft.character.weights.weights != whole.character.weights.weights);
  for (const std::string stage : {"layers", "pieces", "mesh", "stretch", "silhouette", "recognition"})
    CHECK_FALSE(stagesOf(draft).contains(stage));

  // Where more has changed than joints there is nothing to draw on.
  RigOptions options = document.options();
  options.height_m = 3;
  document.setOptions(options);
  document.moveJoint("left_hand", there + Eigen::Vector2d(3, 3));
  CHECK(stagesOf(*document.draft()).contains("mesh"));
  CHECK(document.draft() == document.rigged());
}

TEST_CASE("of a document the neck follows a moved shoulder, unless somebody has placed it") {
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  const auto at = [&](const char* name) {
    const Skeleton& skeleton = document.rigged()->recognition.skeleton;
    return skeleton.joints[std::size_t(skeleton.index(name))].image;
  };
  const Eigen::Vector2d pelvis = at("pelvis");
  document.moveJoint("left_shoulder", at("left_shoulder") + Eigen::Vector2d(8, -6));
  CHECK((at("neck") - (at("left_shoulder") + at("right_shoulder")) / 2).norm() < .02);
  CHECK((at("pelvis") - pelvis).norm() < .02);
  const Eigen::Vector2d neck = at("neck") + Eigen::Vector2d(1, 5);
  document.moveJoint("neck", neck);
  document.moveJoint("right_shoulder", at("right_shoulder") + Eigen::Vector2d(-4, -6));
  CHECK((at("neck") - neck).norm() < .02);
}

TEST_CASE("a document tells the limbs before the body without making a model of them") {
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  const LayerMap layers = document.layers();
  REQUIRE(layers.part.size() > 0);
  const auto rigged = document.rigged();
  CHECK((layers.part == rigged->layers.part).all());
  CHECK_FALSE(stagesOf(*rigged).contains("layers"));  // known already
  CHECK(stagesOf(*rigged).contains("mesh"));
}

TEST_CASE("a document that cannot be rigged says why, and goes on when it can") {
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  document.setLayers(NamedPicture{Image(3, 3), "small.png"});
  CHECK_THROWS_AS(document.rigged(), InputError);
  CHECK_THROWS_AS(document.draft(), InputError);
  CHECK_THROWS_AS(document.moveJoint("left_hand", {1, 1}), InputError);
  document.setLayers(std::nullopt);
  CHECK(document.rigged()->found());
  CHECK_THROWS_AS(document.moveJoint("left_wing", {1, 1}), UsageError);
  document.setMask(Plane8(Plane8::Zero(600, 600)));
  CHECK_FALSE(document.rigged()->found());
  CHECK_THROWS_AS(document.moveJoint("left_hand", {1, 1}), UsageError);
  document.setMask(std::nullopt);
  CHECK(document.rigged()->found());
}

TEST_CASE("a joint cannot be moved to where no joint can be, and the document stays as it is") {
  RigDocument document(rigOptions("biped"));
  document.setImage(drawingCalled("characters/cap_boy.png"));
  const auto rigged = document.rigged();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Vector2d& there :
       {Eigen::Vector2d(nan, 1), Eigen::Vector2d(1, std::numeric_limits<double>::infinity()),
        Eigen::Vector2d(1e30, 1)}) {
    CHECK_THROWS_WITH(document.moveJoint("left_hand", there),
                      "RigDocument::moveJoint(): the place of \"left_hand\" must be finite numbers of at "
                      "most 1e6 px");
    CHECK(document.rigged() == rigged);
  }
  document.moveJoint("left_hand", {-500, 900});
  CHECK(document.draft()->found());
  CHECK(document.rigged()->found());
}

TEST_CASE("another drawing does not wear the joints, the mask and the layers of the one before") {
  const Image boy = drawingCalled("characters/cap_boy.png"), alien = drawingCalled("characters/alien.png");
  RigDocument document(rigOptions("biped")), fresh(rigOptions("biped"));
  document.setImage(boy);
  fresh.setImage(alien);
  const auto first = document.rigged();
  document.moveJoint("left_hand", {100, 100});
  document.setMask(first->silhouette.mask);
  document.setLayers(NamedPicture{layerPicture(first->layers, first->silhouette.mask), "limbs.png"});
  document.setImage(alien);
  CHECK_FALSE(document.input().skeleton);
  CHECK_FALSE(document.input().mask);
  CHECK_FALSE(document.input().layers);
  CHECK(encodeGlb(document.draft()->character, {}) == encodeGlb(fresh.rigged()->character, {}));

  // A smaller one under an old mask was an abort.
  document.setMask(document.rigged()->silhouette.mask);
  Image blank(300, 400);
  blank.rgba.setConstant(255);
  document.setImage(blank);
  CHECK_FALSE(document.rigged()->found());

  // The same is no other, and a new input brings its own.
  document.setImage(boy);
  document.moveJoint("left_hand", {100, 100});
  const RigInput moved = document.input();
  document.setImage(boy);
  CHECK(document.input().skeleton);
  document.setImage(alien);
  document.setInput(moved);
  REQUIRE(document.input().skeleton);
  const Skeleton& skeleton = document.rigged()->recognition.skeleton;
  CHECK(skeleton.joints[std::size_t(skeleton.index("left_hand"))].image == Eigen::Vector2d(100, 100));

  // What is set before the first picture is meant for it.
  RigDocument early(rigOptions("biped"));
  early.setMask(first->silhouette.mask);
  early.setImage(boy);
  CHECK(early.input().mask);
}

TEST_CASE("a document's errors name its file, and a finder of figures is refused") {
  RigDocument document(rigOptions("biped"));
  RigInput input;
  input.file = "hero.png";
  document.setInput(input);
  CHECK_THROWS_WITH(document.rigged(), "hero.png: has neither a picture nor a model");
  FigureFinder figures{SilhouetteOptions()};
  input.figures = &figures;
  CHECK_THROWS_AS(document.setInput(input), UsageError);
}
