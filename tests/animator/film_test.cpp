#include "animator/film.h"

#include <algorithm>

#include "animator/flat_figure.h"
#include "animator/load_character.h"
#include "tests/animator/figure_file.h"
#include "tests/support/catch.h"
#include "tests/support/clips_on_drawings.h"

using namespace skel;

namespace {

class Frames : public VideoWriter {
 public:
  void add(const Image& frame) override { frames.push_back(frame); }
  void finish() override {}
  std::vector<Image> frames;
};

FilmOptions small() {
  FilmOptions options;
  options.width = 80;
  options.height = 96;
  options.frame_rate = 20;
  return options;
}

}  // namespace

TEST_CASE("a film has the clip's frames in their order, and repeats it") {
  const RiggedCharacter character = figure();
  const Scene scene(character, softwarePainter(character.mesh));
  FilmOptions options = small();
  CHECK(frameCount(nodClip(), options) == 20);
  CHECK(frameCount(Clip(), options) == 1);
  options.duration_s = 2.5;
  const Camera camera = filmCamera(character, {nodClip()}, 0.4, 0.1, 80.0 / 96);
  Frames film;
  int told = 0;
  writeFilm(scene, nodClip(), camera, options, film, [&] { ++told; });
  REQUIRE(film.frames.size() == 50);
  CHECK(told == 50);
  for (int i = 0; i < 50; ++i) {
    const Image alone =
        scene.paint(posedAt(character, nodClip(), i % 20 / 20.0), camera, 80, 96, options.look);
    CAPTURE(i);
    CHECK((film.frames[std::size_t(i)].rgba == alone.rgba).all());
  }
}

TEST_CASE("the last pose of a motion that does not come back to its first was in no frame") {
  FilmOptions options = small();
  Clip clip = nodClip();
  const int count = frameCount(clip, options);
  clip.tracks.front().rotations.back() =
      Eigen::Quaternionf(Eigen::AngleAxisf(0.5F, Eigen::Vector3f::UnitX()));
  CHECK(frameCount(clip, options) == count + 1);
  CHECK(timeOf(count, clip, options) == double(clip.duration_s()));
  CHECK(timeOf(count - 1, clip, options) < double(clip.duration_s()));
  for (JointTrack& track : clip.tracks)
    for (float& time_s : track.times_s) time_s *= 0.9F;  // 0.9 s is no whole number of frames in binary
  options.frame_rate = 30;
  const int last = frameCount(clip, options) - 1;
  CHECK(last == 27);
  CHECK(timeOf(last, clip, options) == double(clip.duration_s()));
  options.frame_rate = 20;
  for (JointTrack& track : clip.tracks)
    for (float& time_s : track.times_s) time_s /= 0.9F;
  clip.loops = true;
  CHECK(frameCount(clip, options) == count);
  clip.loops = false;
  options.duration_s = 2.5;
  CHECK(frameCount(clip, options) == 50);
}

TEST_CASE("what goes wrong in a writer comes out of the film") {
  class Full : public VideoWriter {
    void add(const Image&) override { throw std::runtime_error("full"); }
    void finish() override {}
  } full;
  const RiggedCharacter character = figure();
  const Scene scene(character, softwarePainter(character.mesh));
  CHECK_THROWS_WITH(writeFilm(scene, nodClip(), framingCamera(character.mesh.vertices), small(), full, [] {}),
                    "full");
}

TEST_CASE("the film's camera sees every moment of the clip") {
  const RiggedCharacter character = figure();
  Clip jump = nodClip();
  jump.root_times_s = {0, 0.5f, 1};
  jump.root_translations = {{0, 0, 0}, {0.3f, 0.8f, 0}, {0, 0, 0}};
  const Scene scene(character, softwarePainter(character.mesh));
  FilmOptions options = small();
  options.look.background = kClear;
  options.look.shadow = false;
  Frames film;
  writeFilm(scene, jump, filmCamera(character, {jump}, 0, 0, 80.0 / 96), options, film, [] {});
  for (const Image& frame : film.frames)
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x)
        if (x == 0 || y == 0 || x == frame.width - 1 || y == frame.height - 1)
          REQUIRE(frame.pixel(x, y)[3] == 0);
}

TEST_CASE("the camera of very many clips looks at as many moments as fit into memory") {
  const RiggedCharacter character = figure();
  std::vector<Clip> clips(20'000, nodClip());
  for (std::size_t i = 19'000; i < clips.size(); ++i) {  // all parts of the list are looked at
    clips[i].root_times_s = {0};
    clips[i].root_translations = {{0, 3, 0}};
  }
  const Eigen::MatrixX3f points = outermostPoints(character, clips);
  CHECK(points.rows() < 21'000'000);
  CHECK(points.col(1).maxCoeff() > 3);
}

TEST_CASE("an arm that is one piece with the body in the model is one with it in the drawing that moves") {
  RiggedDrawing drawing =
      rigWithClips(std::string(SKEL_SOURCE_DIR) + "/datasets/characters/cap_boy.png", "biped", {});
  drawing.layers.limb.resize(0, 0);
  drawing.layers.hidden.clear();
  const Eigen::Quaternionf up(Eigen::AngleAxisf(1, Eigen::Vector3f::UnitZ()));
  Clip wave;
  wave.tracks = {
      {"left_shoulder", {0, 0.5f, 1}, {Eigen::Quaternionf::Identity(), up, Eigen::Quaternionf::Identity()}}};
  const auto moved = [&] {
    const FlatFigure flat(drawing);
    const FilmOptions options = small();
    const Camera camera = flat.camera({wave}, double(options.width) / options.height);
    const CutOutPainter painter = flat.painterFor(camera, options.height);
    const Image before = flat.paint(wave, {}, 0, camera, painter, options),
                after = flat.paint(wave, {}, double(wave.duration_s()) / 2, camera, painter, options);
    return (before.rgba != after.rgba).rowwise().any().count();
  };
  CHECK(moved() > 0);
  const Skeleton& skeleton = drawing.character.skeleton;
  const auto body = std::uint16_t(skeleton.index("body"));
  drawing.character.weights.joints =
      drawing.character.weights.joints
          .unaryExpr([&](std::uint16_t joint) {
            const std::string& name = skeleton.joints[joint].name;
            return name.ends_with("shoulder") || name.ends_with("elbow") || name.ends_with("hand") ? body
                                                                                                   : joint;
          })
          .eval();
  CHECK(moved() == 0);
}

TEST_CASE("a head that turns aside, a body that bows, was missing from flat films without a word") {
  const RiggedDrawing drawing =
      rigDrawing({.path = SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png"}).drawing;
  const auto turned = [&](const Eigen::Vector3f& axis, const char* joint = "head", float angle_rad = .5f) {
    Clip clip;
    clip.name = "turn";
    JointTrack& track = clip.tracks.emplace_back();
    track.joint = joint;
    track.times_s = {0, 1};
    track.rotations = {Eigen::Quaternionf::Identity(),
                       Eigen::Quaternionf(Eigen::AngleAxisf(angle_rad, axis))};
    return unseenTurn(drawing, clip);
  };
  CHECK(turned(Eigen::Vector3f::UnitY()) ==
        "\"turn\" turns the head aside, which the flat look does not show; --look solid does");
  CHECK_FALSE(turned(Eigen::Vector3f::UnitZ()));
  CHECK(turned(Eigen::Vector3f::UnitX(), "body", .8f) ==
        "\"turn\" bends the body to the front, which the flat look does not show; --look solid does");
  CHECK_FALSE(turned(Eigen::Vector3f::UnitX(), "body", .3f));
  CHECK_FALSE(turned(Eigen::Vector3f::UnitZ(), "body", .8f));
}
