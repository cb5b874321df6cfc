#include "libskel/pipeline/check_rig.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_document.h"
#include "libskel/pipeline/rig_drawing.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();
constexpr float kNaNf = std::numeric_limits<float>::quiet_NaN();

struct Case {
  const char* name;
  std::function<void(RigInput&, RigOptions&)> spoil;
  std::string said;  // a part of it
};

RigInput drawing() {
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  return input;
}

Skeleton given() { return presetSkeleton(loadTemplate("biped"), {150, 20}, {450, 560}); }

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return mesh;
}

Clip nod() {
  Clip clip;
  clip.name = "nod";
  JointTrack track;
  track.joint = "head";
  track.times_s = {0, 1};
  track.rotations = {Eigen::Quaternionf::Identity(), Eigen::Quaternionf(.8f, .6f, 0, 0)};
  clip.tracks = {track};
  return clip;
}

// A case that spoils one of its parts.
Case ofSkeleton(const char* name, const std::function<void(Skeleton&)>& spoil, const std::string& said) {
  return {name,
          [=](RigInput& input, RigOptions&) {
            input.skeleton = given();
            spoil(*input.skeleton);
          },
          "RigInput::skeleton" + said};
}
Case ofModel(const char* name, const std::function<void(TriangleMesh&)>& spoil, const std::string& said) {
  return {name,
          [=](RigInput& input, RigOptions&) {
            input.model = tetrahedron();
            spoil(*input.model);
          },
          "RigInput::model" + said};
}
Case ofClip(const char* name, const std::function<void(Clip&)>& spoil, const std::string& said) {
  return {name,
          [=](RigInput&, RigOptions& options) {
            Clip clip = nod();
            spoil(clip);
            options.clips = {clip};
          },
          "RigOptions::clips: the clip \"nod\": " + said};
}
Case ofOptions(const char* name, const std::function<void(RigOptions&)>& spoil, const std::string& said) {
  return {name, [=](RigInput&, RigOptions& options) { spoil(options); }, "RigOptions::" + said};
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"a size that is larger than its pixels", [](RigInput& i, RigOptions&) { i.image.width = 6000; },
       "RigInput::image has a size of 6000x600 px, its rgba has 360000 rows"},
      {"a size that is smaller than its pixels", [](RigInput& i, RigOptions&) { i.image.height = 60; },
       "RigInput::image has a size of 600x60 px"},
      {"a negative size", [](RigInput& i, RigOptions&) { i.image.width = i.image.height = -600; },
       "RigInput::image has a size of -600x-600 px"},
      {"an image without pixels", [](RigInput& i, RigOptions&) { i.image.rgba.resize(0, 4); },
       "its rgba has 0 rows"},
      {"a small mask", [](RigInput& i, RigOptions&) { i.mask = Plane8::Constant(10, 10, 255); },
       "RigInput::mask is of 10x10 px, RigInput::image has 600x600"},
      {"a large mask", [](RigInput& i, RigOptions&) { i.mask = Plane8::Constant(1200, 1100, 255); },
       "RigInput::mask is of 1100x1200 px, RigInput::image has 600x600"},
      {"an empty mask", [](RigInput& i, RigOptions&) { i.mask = Plane8(); }, "RigInput::mask is of 0x0 px"},
      {"a back whose size lies",
       [](RigInput& i, RigOptions&) {
         i.back = NamedPicture{Image(3, 3), "back"};
         i.back->image.width = 9;
       },
       "RigInput::back has a size of 9x3 px"},
      {"layers whose size lies",
       [](RigInput& i, RigOptions&) {
         i.layers = NamedPicture{i.image, "layers"};
         i.layers->image.rgba.conservativeResize(5, 4);
       },
       "RigInput::layers has a size of 600x600 px"},
      {"placed at no number",
       [](RigInput& i, RigOptions&) {
         i.placed = {{"left_hand", {kNaN, 1}}};
       },
       "RigInput::placed: the place of \"left_hand\" must be finite"},
      {"placed far off",
       [](RigInput& i, RigOptions&) {
         i.placed = {{"left_hand", {1, -1e30}}};
       },
       "RigInput::placed: the place of \"left_hand\" must be finite numbers of at most 1e6 px"},

      ofSkeleton(
          "a skeleton without joints", [](Skeleton& s) { s.joints.clear(); }, " has no joints"),
      ofSkeleton(
          "a joint at no number", [](Skeleton& s) { s.joints[5].image.x() = kNaN; }, ": the place of"),
      ofSkeleton(
          "a joint far off", [](Skeleton& s) { s.joints[5].image.y() = 1e300; }, ": the place of"),
      ofSkeleton(
          "a joint nowhere in the model", [](Skeleton& s) { s.joints[5].position.z() = kInf; }, ".joints[5]"),
      ofSkeleton(
          "a confidence of NaN", [](Skeleton& s) { s.joints[5].confidence = kNaN; }, ": the confidence of"),
      ofSkeleton(
          "parents in a ring", [](Skeleton& s) { s.joints[3].parent = 12; }, ".joints[3]"),
      ofSkeleton(
          "its own parent", [](Skeleton& s) { s.joints[3].parent = 3; }, ".joints[3]"),
      ofSkeleton(
          "a second root", [](Skeleton& s) { s.joints[3].parent = -1; }, ".joints[3]"),
      ofSkeleton(
          "no root", [](Skeleton& s) { s.joints[0].parent = 4; }, ".joints[0]"),
      ofSkeleton(
          "two joints of one name", [](Skeleton& s) { s.joints[3].name = s.joints[4].name; },
          " has two joints"),

      ofModel(
          "an empty model", [](TriangleMesh& m) { m = {}; }, " is empty"),
      ofModel(
          "a vertex that is no number", [](TriangleMesh& m) { m.vertices(1, 1) = kNaNf; }, ".vertices"),
      ofModel(
          "a vertex far off", [](TriangleMesh& m) { m.vertices *= 1e30f; }, ".vertices"),
      ofModel(
          "an index too large", [](TriangleMesh& m) { m.triangles(1, 1) = 99; }, ".triangles"),
      ofModel(
          "a negative index", [](TriangleMesh& m) { m.triangles(1, 1) = -1; }, ".triangles"),
      ofModel(
          "too few texture coordinates", [](TriangleMesh& m) { m.uv.setZero(2, 2); }, ".uv has 2 rows"),
      ofModel(
          "a back beyond the triangles", [](TriangleMesh& m) { m.first_back = 5; }, ".first_back"),
      ofModel(
          "layers of other vertices", [](TriangleMesh& m) { m.layer.setZero(7); }, ".layer has 7 rows"),
      ofModel(
          "a texture whose size lies", [](TriangleMesh& m) { m.texture.width = 4, m.texture.height = 4; },
          ".texture has a size of 4x4 px"),
      ofModel(
          "a flat model", [](TriangleMesh& m) { m.vertices.col(1).setZero(); }, " is flat"),

      ofOptions(
          "figure 0", [](RigOptions& o) { o.silhouette.figure = 0; }, "silhouette.figure is 0"),
      ofOptions(
          "alpha NaN", [](RigOptions& o) { o.silhouette.alpha = kNaN; }, "silhouette.alpha is nan"),
      ofOptions(
          "alpha -1", [](RigOptions& o) { o.silhouette.alpha = -1; }, "silhouette.alpha is -1"),
      ofOptions(
          "five influences", [](RigOptions& o) { o.skin.max_influences = 5; },
          "skin.max_influences is 5, must be from 1 to 4"),
      ofOptions(
          "smoothing for hours", [](RigOptions& o) { o.skin.smoothing = 2147483647; }, "skin.smoothing"),
      ofOptions(
          "an unknown way to bind the skin", [](RigOptions& o) { o.skin_method = SkinMethod(77); },
          "skin_method"),
      ofOptions(
          "spacing NaN", [](RigOptions& o) { o.inflate.spacing_px = kNaN; }, "inflate.spacing_px is nan"),
      ofOptions(
          "spacing -1", [](RigOptions& o) { o.inflate.spacing_px = -1; }, "inflate.spacing_px is -1"),
      ofOptions(
          "thickness 0", [](RigOptions& o) { o.inflate.thickness = 0; }, "inflate.thickness is 0"),
      ofOptions(
          "thickness 1e9", [](RigOptions& o) { o.inflate.thickness = 1e9; }, "inflate.thickness is 1e+09"),
      ofOptions(
          "thickness NaN", [](RigOptions& o) { o.inflate.thickness = kNaN; }, "inflate.thickness is nan"),
      ofOptions(
          "a texture of 1 px", [](RigOptions& o) { o.inflate.max_texture_px = 1; },
          "inflate.max_texture_px is 1, must be 32 or more"),
      ofOptions(
          "a body NaN high", [](RigOptions& o) { o.inflate.height_m = kNaN; }, "inflate.height_m is nan"),
      ofOptions(
          "height NaN", [](RigOptions& o) { o.height_m = kNaN; }, "height_m is nan"),
      ofOptions(
          "height -1", [](RigOptions& o) { o.height_m = -1; }, "height_m is -1"),
      ofOptions(
          "height without end", [](RigOptions& o) { o.height_m = kInf; }, "height_m is inf"),
      ofOptions(
          "next to no height", [](RigOptions& o) { o.height_m = 1e-320; }, "height_m is"),
      ofOptions(
          "into_picture NaN", [](RigOptions& o) { o.into_picture = kNaN; }, "into_picture is nan"),
      ofOptions(
          "into_picture -1", [](RigOptions& o) { o.into_picture = -1; }, "into_picture is -1"),
      ofOptions(
          "an empty net", [](RigOptions& o) { o.mlp = {}; }, "mlp"),
      ofOptions(
          "a net of another shape", [](RigOptions& o) { o.mlp.layers.pop_back(); }, "mlp"),
      ofOptions(
          "a net of no numbers", [](RigOptions& o) { o.mlp.layers[0].biases[0] = kNaNf; }, "mlp"),
      ofOptions(
          "an empty body plan", [](RigOptions& o) { o.body_plan = {}; }, "body_plan: has no joints"),
      ofOptions(
          "a body plan of half its joints", [](RigOptions& o) { o.body_plan.joints.resize(4); },
          "body_plan: "),
      ofOptions(
          "another body plan in a ring", [](RigOptions& o) { o.otherwise->body_plan.joints[2].parent = 5; },
          "otherwise->body_plan: joints[2].parent"),

      ofClip(
          "a rotation of no numbers", [](Clip& c) { c.tracks[0].rotations[1].x() = kNaNf; },
          "tracks[0].rotations[1] is no rotation"),
      ofClip(
          "a rotation of length 0", [](Clip& c) { c.tracks[0].rotations[1].coeffs().setZero(); },
          "tracks[0].rotations[1] is no rotation"),
      ofClip(
          "fewer rotations than times", [](Clip& c) { c.tracks[0].rotations.pop_back(); },
          "tracks[0].rotations has 1 keys, times_s has 2"),
      ofClip(
          "fewer times than rotations", [](Clip& c) { c.tracks[0].times_s.pop_back(); },
          "tracks[0].rotations has 2 keys, times_s has 1"),
      ofClip(
          "fewer angles",
          [](Clip& c) {
            c.tracks[0].angles_rad = {{0, 0, 0}};
          },
          "tracks[0].angles_rad has 1"),
      ofClip(
          "a track without keys", [](Clip& c) { c.tracks[0].times_s.clear(), c.tracks[0].rotations.clear(); },
          "tracks[0].times_s"),
      ofClip(
          "a time that is none", [](Clip& c) { c.tracks[0].times_s[1] = kNaNf; }, "tracks[0].times_s[1]"),
      ofClip(
          "a time before 0", [](Clip& c) { c.tracks[0].times_s[0] = -1; }, "tracks[0].times_s[0]"),
      ofClip(
          "times that go back",
          [](Clip& c) {
            c.tracks[0].times_s = {1, 0};
          },
          "tracks[0].times_s[1]"),
      ofClip(
          "a scale of NaN",
          [](Clip& c) {
            c.tracks[0].scale_times_s = {0}, c.tracks[0].scales = {{kNaNf, 1, 1}};
          },
          "tracks[0].scales[0]"),
      ofClip(
          "translations without times",
          [](Clip& c) {
            c.tracks[0].translations_m = {{0, 0, 0}};
          },
          "tracks[0].translations_m has 1"),
      ofClip(
          "a bone of NaN", [](Clip& c) { c.tracks[0].bone.setConstant(kNaNf); }, "tracks[0].bone"),
      ofClip(
          "a root of NaN",
          [](Clip& c) {
            c.root_times_s = {0}, c.root_translations = {{kNaNf, 0, 0}};
          },
          "root_translations[0]"),
      ofClip(
          "fewer places of the root",
          [](Clip& c) {
            c.root_times_s = {0, 1}, c.root_translations = {{0, 0, 0}};
          },
          "root_translations has 1 keys, root_times_s has 2"),
      ofClip(
          "two tracks of one joint", [](Clip& c) { c.tracks.push_back(c.tracks[0]); },
          "tracks[1].joint is \"head\", which has a track already"),
      ofClip(
          "a contact that never begins",
          [](Clip& c) {
            c.contacts = {{"left_foot", kNaNf, 1}};
          },
          "contacts"),
      {"a clip whose name is no UTF-8",
       [](RigInput&, RigOptions& o) {
         Clip clip = nod();
         clip.name = "\xff\xfe";
         o.clips = {clip};
       },
       "name is no UTF-8"},
      ofClip(
          "a place of the root that no reader takes",
          [](Clip& c) {
            c.root_times_s = {0}, c.root_translations = {{3e38f, 0, 0}};
          },
          "root_translations[0] must hold finite numbers of at most 1e6"),
      ofClip(
          "a lead of NaN", [](Clip& c) { c.lead_s = kNaNf; }, "lead_s"),
      {"a clip of another body plan that is none",
       [](RigInput&, RigOptions& o) {
         Clip clip = nod();
         clip.tracks[0].rotations.pop_back();
         o.otherwise->clips = {clip};
       },
       "RigOptions::otherwise->clips: the clip \"nod\": tracks[0].rotations has 1 keys"},
  };
  return all;
}

std::string usageErrorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

}  // namespace

TEST_CASE("what makes no sense to be rigged is a UsageError that names the member, not an abort") {
  const RigInput good = drawing();
  const RigOptions options = rigOptions();
  CHECK_NOTHROW(checkRig(good, options));
  for (const Case& one : cases()) {
    CAPTURE(one.name);
    RigInput input = good;
    RigOptions asked = options;
    one.spoil(input, asked);
    const std::string said = usageErrorOf([&] { checkRig(input, asked); });
    CHECK_THAT(said, Catch::Matchers::Contains(one.said));
    CHECK(std::count(said.begin(), said.end(), '\n') == 0);
    CHECK(said == usageErrorOf([&] { rigCharacter(input, asked); }));
    RigDocument document(asked);
    document.setInput(input);
    CHECK(said == usageErrorOf([&] { document.rigged(); }));
    CHECK(said == usageErrorOf([&] { document.draft(); }));
    CHECK(said == usageErrorOf([&] { document.layers(); }));
  }
}

TEST_CASE("a clip of a clip list that lasts for years is refused before its poses are made") {
  RigOptions options;
  Clip clip = nod();
  clip.tracks[0].times_s[1] = 1e9f;
  options.clips = {clip};
  CHECK_THROWS_WITH(rigCharacter(drawing(), options),
                    "the clip \"nod\" lasts more than an hour; cut it into parts");
}

TEST_CASE("what may be odd is rigged") {
  const std::vector<std::pair<const char*, std::function<void(RigInput&, RigOptions&)>>> odd = {
      {"the image alone", [](RigInput&, RigOptions&) {}},
      {"a model alone, without a picture",
       [](RigInput& i, RigOptions& o) {
         i.model = tetrahedron(), i.image = Image();
         o.clips.clear();
       }},
      {"a mask beside a model's own view",
       [](RigInput& i, RigOptions& o) {
         i.model = tetrahedron(), i.image = Image(), i.mask = Plane8::Constant(3, 3, 255);
         o.clips.clear();
       }},
      {"a joint beside the picture",
       [](RigInput& i, RigOptions&) {
         i.placed = {{"left_hand", {-500, 900}}};
       }},
      {"no clips", [](RigInput&, RigOptions& o) { o.clips.clear(); }},
      {"a clip without tracks", [](RigInput&, RigOptions& o) { o.clips = {Clip()}; }},
      {"rotations of length 5",
       [](RigInput&, RigOptions& o) {
         o.clips = {nod()};
         for (auto& rotation : o.clips[0].tracks[0].rotations) rotation.coeffs() *= 5;
       }},
  };
  for (const auto& [name, change] : odd) {
    CAPTURE(name);
    RigInput input = drawing();
    RigOptions options = rigOptions("biped");
    change(input, options);
    CHECK_NOTHROW(rigCharacter(std::move(input), options));
  }
}

// The members that are named have defaults for the others: no warning where warnings are errors.
TEST_CASE("inputs and options can be made by naming some of their members") {
  const RigInput input{.image = Image(3, 3), .turned_deg = 90};
  CHECK(input.image.width == 3);
  CHECK(RigOptions{.last = LastStage::kJoints}.clips.empty());
}
