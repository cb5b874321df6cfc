#include <cmath>
#include <numbers>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/import/read_character.h"
#include "libskel/skeleton/hanging.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

// Without printing thousands of numbers.
template <class A, class B>
bool same(const A& a, const B& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

// Turned about the upright and moved.
JointTrack movedTrack(const std::string& joint) {
  JointTrack track;
  track.joint = joint;
  track.times_s = {0, 1};
  track.rotations = {Eigen::Quaternionf::Identity(), Eigen::Quaternionf(0.8f, 0, 0.6f, 0)};
  track.translation_times_s = {0, 0.5f};
  track.translations_m = {{0, 0, 0}, {0.1f, 0.2f, 0.3f}};
  return track;
}

}  // namespace

TEST_CASE("a model whose back wears its own part of the texture is parted in the file and whole again") {
  RiggedCharacter character = figure();
  TriangleMesh& mesh = character.mesh;
  mesh.back_uv = 0.5f * mesh.uv;
  mesh.first_back = mesh.triangles.rows() / 2;
  const std::string bytes = encodeGlb(character, {}, {.name = "figure"});
  const CharacterFile file = decodeGlb(bytes, "a.glb");
  CHECK(file.character.mesh.vertices == mesh.vertices);
  CHECK(file.character.mesh.triangles == mesh.triangles);
  CHECK(file.character.weights.joints.rows() == mesh.vertices.rows());
  const bool same_bytes = encodeGlb(file.character, {}, {.name = file.name}) == bytes;
  CHECK(same_bytes);
}

TEST_CASE(
    "the line around a figure is written into the GLB and read back, as a hull where that is asked for") {
  RiggedCharacter character = figure();
  CHECK(decodeGlb(encodeGlb(character, {}, {.ink_hull = true}), "a.glb").character.mesh.ink.width_m == 0);
  character.mesh.ink = {0.0125f, {30, 20, 10}};
  for (const bool ink_hull : {false, true}) {
    const std::string bytes = encodeGlb(character, {}, {.name = "figure", .ink_hull = ink_hull});
    const CharacterFile file = decodeGlb(bytes, "a.glb");
    CHECK(file.ink_hull == ink_hull);
    CHECK(file.character.mesh.ink.width_m == character.mesh.ink.width_m);
    CHECK(file.character.mesh.ink.rgb == character.mesh.ink.rgb);
    CHECK(same(file.character.mesh.vertices, character.mesh.vertices));
    const bool same_bytes = encodeGlb(file.character, {}, {.name = "figure", .ink_hull = ink_hull}) == bytes;
    CHECK(same_bytes);
  }
}

TEST_CASE("which way a figure looks is written into the GLB and read back") {
  RiggedCharacter character = figure();
  CHECK_FALSE(decodeGlb(encodeGlb(character, {}), "a.glb").character.facing);
  character.facing = Facing::at(-std::numbers::pi / 4);
  const auto facing = decodeGlb(encodeGlb(character, {}), "a.glb").character.facing;
  REQUIRE(facing);
  CHECK(facing->yaw_rad == Approx(-std::numbers::pi / 4));
  CHECK(facing->looks == -1);
  character.facing->yaw_rad = std::nan("");
  CHECK_THROWS_AS(encodeGlb(character, {}), UsageError);
}

TEST_CASE("what is written as GLB is read back whole, and without clips gives the same bytes again") {
  RiggedCharacter character = figure();
  const std::vector<Clip> clips = {retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton)};
  const std::string bytes = encodeGlb(character, clips, {.name = "figure"});
  const CharacterFile file = decodeGlb(bytes, "figure.glb");
  CHECK(file.name == "figure");
  CHECK(same(file.character.mesh.vertices, character.mesh.vertices));
  CHECK(same(file.character.mesh.triangles, character.mesh.triangles));
  CHECK((file.character.mesh.uv - character.mesh.uv).cwiseAbs().maxCoeff() < 1e-5f);
  CHECK(same(file.character.mesh.texture.rgba, character.mesh.texture.rgba));
  CHECK(file.character.skeleton.template_name == "biped");
  REQUIRE(file.character.skeleton.joints.size() == character.skeleton.joints.size());
  for (std::size_t j = 0; j < character.skeleton.joints.size(); ++j) {
    CHECK(file.character.skeleton.joints[j].name == character.skeleton.joints[j].name);
    CHECK(file.character.skeleton.joints[j].parent == character.skeleton.joints[j].parent);
    CHECK((file.character.skeleton.joints[j].position - character.skeleton.joints[j].position).norm() < 2e-6);
  }
  CHECK(same(file.character.weights.joints, character.weights.joints));
  CHECK((file.character.weights.weights - character.weights.weights).cwiseAbs().maxCoeff() < 2e-5f);
  REQUIRE(file.clips.size() == 1);
  CHECK(file.clips[0].name == "wave");
  REQUIRE(file.clips[0].tracks.size() == clips[0].tracks.size());
  for (std::size_t t = 0; t < clips[0].tracks.size(); ++t) {
    CHECK(file.clips[0].tracks[t].joint == clips[0].tracks[t].joint);
    CHECK(file.clips[0].tracks[t].times_s == clips[0].tracks[t].times_s);
    for (std::size_t i = 0; i < clips[0].tracks[t].rotations.size(); ++i)
      CHECK(file.clips[0].tracks[t].rotations[i].angularDistance(clips[0].tracks[t].rotations[i]) < 2e-6f);
  }
  const bool same_bytes =
      encodeGlb(file.character, {}, {.name = file.name}) == encodeGlb(character, {}, {.name = "figure"});
  CHECK(same_bytes);
}

TEST_CASE("whatever the axes of the joints, the character is read as it was and gives the same bytes again") {
  const RiggedCharacter character = figure();
  const Clip wave = retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton);
  for (const BoneStyle style : {BoneStyle::kAlong, BoneStyle::kEnds, BoneStyle::kPlain}) {
    const std::string bytes = encodeGlb(character, {}, {.name = "figure", .bones = style});
    const CharacterFile file = decodeGlb(bytes, "figure.glb");
    CHECK(file.bones == style);
    CHECK(file.character.skeleton.joints.size() == character.skeleton.joints.size());
    CHECK(file.character.skeleton.template_name == "biped");
    const bool same_bytes = encodeGlb(file.character, {}, {.name = file.name, .bones = file.bones}) == bytes;
    CHECK(same_bytes);
    const Clip back = decodeGlb(encodeGlb(character, {wave}, {.bones = style}), "figure.glb").clips.at(0);
    REQUIRE(back.tracks.size() == wave.tracks.size());
    for (std::size_t t = 0; t < wave.tracks.size(); ++t)
      for (std::size_t i = 0; i < wave.tracks[t].rotations.size(); ++i)
        CHECK(back.tracks[t].rotations[i].angularDistance(wave.tracks[t].rotations[i]) < 2e-6f);
  }
}

TEST_CASE("clips that move and scale joints and the root come back from GLB") {
  const RiggedCharacter character = figure();
  Clip clip;
  clip.name = "all";
  JointTrack track = movedTrack("head");
  track.scale_times_s = {0.25f};
  track.scales = {{1, 2, 1}};
  clip.tracks = {track};
  clip.root_times_s = {0, 1};
  clip.root_translations = {{0, 0, 0}, {0, 0.25f, 0.125f}};
  const CharacterFile file = decodeGlb(encodeGlb(character, {clip}), "a.glb");
  REQUIRE(file.clips.size() == 1);
  const Clip& back = file.clips[0];
  REQUIRE(back.tracks.size() == 1);
  CHECK(back.tracks[0].joint == "head");
  CHECK(back.tracks[0].times_s == track.times_s);
  CHECK(back.tracks[0].rotations[1].angularDistance(track.rotations[1]) < 1e-6f);
  CHECK(back.tracks[0].translation_times_s == track.translation_times_s);
  CHECK((back.tracks[0].translations_m[1] - track.translations_m[1]).norm() < 2e-6f);
  CHECK(back.tracks[0].scale_times_s == track.scale_times_s);
  CHECK(back.tracks[0].scales[0] == track.scales[0]);
  CHECK(back.root_times_s == clip.root_times_s);
  CHECK((back.root_translations[1] - clip.root_translations[1]).norm() < 2e-6f);
}

TEST_CASE("a clip's poses are the same in the joints' own axes and in the model's") {
  const RiggedCharacter character = figure();
  Clip clip;
  clip.name = "move";
  JointTrack track = movedTrack("right_elbow");
  track.scale_times_s = {0};
  track.scales = {{1.5f, 1.5f, 1.5f}};
  clip.tracks = {track};
  const Clip back = decodeGlb(encodeGlb(character, {clip}), "a.glb").clips.at(0);
  CHECK(back.tracks[0].rotations[1].angularDistance(track.rotations[1]) < 1e-6f);
  CHECK((back.tracks[0].translations_m[1] - track.translations_m[1]).norm() < 2e-6f);
  CHECK(back.tracks[0].scales[0] == track.scales[0]);
}

TEST_CASE("a joint keeps its name where another has the one that the target program wants") {
  RiggedCharacter character = figure();
  Joint& tip = character.skeleton.joints[character.skeleton.index("head_top")];
  tip.name = "hips";
  ExportOptions options;
  options.naming = JointNaming::kVrm;
  const Skeleton back = decodeGlb(encodeGlb(character, {}, options), "a.glb").character.skeleton;
  CHECK(back.find("pelvis") == 0);
  CHECK(back.find("hips") > 0);
  CHECK(back.find("spine") > 0);
}

TEST_CASE("a file says which of its clips loop, a gallop among them") {
  RiggedCharacter character = figure();
  Clip gallop = retargetToRest(clipNamed(builtinClips(), "walk"), character.skeleton);
  gallop.loops = clipNamed(builtinClips(), "gallop").loops;
  const Clip wave = retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton);
  std::string bytes = encodeGlb(character, {gallop, wave});
  const CharacterFile file = decodeGlb(bytes, "a.glb");
  CHECK(file.clips[0].loops);
  CHECK_FALSE(file.clips[1].loops);
  // What others have put there is none of ours.
  const std::size_t mark = bytes.find("\"loop\":true");
  REQUIRE(mark != std::string::npos);
  bytes.replace(mark, 11, "\"loop\":1111");
  CHECK_FALSE(decodeGlb(bytes, "a.glb").clips[0].loops);
}

TEST_CASE("a character with a cape that hangs was read back as of no body plan") {
  RiggedCharacter character = figure();
  Joint joint = character.skeleton.joints[std::size_t(character.skeleton.index("neck"))];
  joint.name = hangingJointName("cape", 1);
  joint.parent = character.skeleton.index("neck");
  joint.position.y() -= .1;
  character.skeleton.joints.push_back(joint);
  CHECK(decodeGlb(encodeGlb(character, {}), "a.glb").character.skeleton.template_name == "biped");
  character.skeleton.joints.back().name = "cape";
  CHECK(decodeGlb(encodeGlb(character, {}), "a.glb").character.skeleton.template_name.empty());
}
