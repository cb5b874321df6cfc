#include "animator/render_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <numbers>

#include "animator/film.h"
#include "animator/flat_figure.h"
#include "animator/load_character.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/progress.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"

namespace skel {
namespace {

struct Size {
  int width = 0, height = 0;
};

Size sizeOf(const std::string& text) {
  Size size;
  const char *begin = text.data(), *end = begin + text.size();
  const auto width = std::from_chars(begin, end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc() && height.ptr == end && size.width > 0 && size.height > 0) return size;
  }
  throw UsageError("--size is \"" + text + "\", must be WIDTHxHEIGHT in px, such as 512x512");
}

void setBackground(Look& look, const std::string& text, const Size& size) {
  if (const auto color = backgroundColor(text))
    look.background = *color;
  else
    look.picture = covering(readImage(text), size.width, size.height);
}

std::unique_ptr<MeshPainter> painterFor(const std::string& name, const TriangleMesh& mesh) {
  if (name == "gl") return offscreenPainter(mesh);
  return name == "software" ? softwarePainter(mesh) : fastestPainter(mesh);
}

}  // namespace

void bindRenderOptions(CLI::App& app, RenderCommandOptions& options) {
  bindCharacterSource(app, options.source);
  app.add_option("--clip", options.clip,
                 "A clip of the file, one that comes with skel, or a file: .clip.json, .bvh, key frames")
      ->required();
  app.add_option("-o,--output", options.output,
                 "The film: " + videoFormatNames() + " (a name that ends with /) of PNG files")
      ->required()
      ->check(outputFile());
  app.add_option("--fps", options.frame_rate, "Frames a second")
      ->check(numberIn(0.1, 240.0))
      ->capture_default_str();
  bindClipSource(app, options.clips);
  app.add_option("--duration", options.duration_s, "In seconds; the clip repeats (default: once)")
      ->check(numberIn(0.0, 3600.0));
  app.add_option("--look", options.look,
                 "solid: the model; flat: the drawing itself, its limbs moved in the picture, unlit")
      ->check(CLI::IsMember({"solid", "flat"}))
      ->capture_default_str();
  app.add_option("--size", options.size, "WIDTHxHEIGHT, px")->capture_default_str();
  app.add_option("--angle", options.angle_deg,
                 "From where it is seen: 0 from the front, 90 from its left, degrees")
      ->check(numberIn(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--pitch", options.pitch_deg, "How far from above, degrees")
      ->check(numberIn(-89.0, 89.0))
      ->capture_default_str();
  app.add_option("--frame", options.frame,
                 "What the camera shows all of: this clip, or all clips of the character, so that films of "
                 "one have one scale and one ground")
      ->check(CLI::IsMember({"clip", "clips"}))
      ->capture_default_str();
  app.add_option("--background", options.background,
                 "white, grey, black, #rrggbb, none (transparent), or a picture")
      ->capture_default_str();
  app.add_flag("--wireframe", options.wireframe, "The mesh's edges as well");
  app.add_flag("--translucent", options.translucent, "The body can be seen through");
  app.add_flag("--show-skeleton", options.skeleton, "The skeleton over the body");
  app.add_option("--show-weights", options.weights_of, "The weights of this joint as colours")
      ->type_name("JOINT");
  app.add_flag("--no-shadow", options.no_shadow, "No shadow on the ground");
  app.add_option("--blend", options.blend, "How joints move the skin: matrices, or dual quaternions")
      ->check(CLI::IsMember({"linear", "dual"}))
      ->capture_default_str();
  app.add_option("--painter", options.painter, "What draws: auto takes a graphics card if there is one")
      ->check(CLI::IsMember({"auto", "software", "gl"}))
      ->capture_default_str();
}

ExitCode runRender(const RenderCommandOptions& options) {
  const Size size = sizeOf(options.size);
  FilmOptions film;
  film.width = size.width;
  film.height = size.height;
  film.frame_rate = options.frame_rate;
  film.duration_s = options.duration_s;
  film.look.wireframe = options.wireframe;
  film.look.translucent = options.translucent;
  film.look.skeleton = options.skeleton;
  film.look.shadow = !options.no_shadow;
  if (options.blend == "dual") film.look.blending = Blending::kDualQuaternions;
  setBackground(film.look, options.background, size);

  VideoOptions video_options{.width = size.width, .height = size.height, .frame_rate = options.frame_rate};
  video_options.transparent = film.look.background.a < 255 && film.look.picture.empty();
  // What cannot be written is said before anything is rigged.
  openVideo(options.output, video_options);

  const bool flat = options.look == "flat";
  if (flat &&
      (options.angle_deg != 0 || options.wireframe || options.translucent || !options.weights_of.empty()))
    throw UsageError(
        "--look flat shows the drawing as it was drawn: leave out --angle, --wireframe, "
        "--translucent and --show-weights");
  ClipSource clips = options.clips;
  clips.flat = flat;
  RiggedDrawing drawing;
  CharacterFile file;
  if (flat) {
    drawing = loadDrawing(options.source);
    file.character = drawing.character;
  } else {
    file = loadCharacter(options.source);
  }
  const Clip clip = clipFor(options.clip, file, clips);
  if (!options.weights_of.empty()) {
    film.look.weights_of = file.character.skeleton.find(options.weights_of);
    if (film.look.weights_of < 0)
      throw UsageError("--show-weights: there is no joint \"" + options.weights_of + "\" in " +
                       options.source.path);
  }
  const int frames = frameCount(clip, film);
  video_options.frames = frames;
  const auto video = openVideo(options.output, video_options);
  std::vector<Clip> shown = {clip};
  if (options.frame == "clips") {
    for (const Clip& other : file.clips) shown.push_back(other);
    for (Clip& other : libraryFor(file.character, clips))
      if (std::none_of(shown.begin(), shown.end(), [&](const Clip& c) { return c.name == other.name; }))
        shown.push_back(std::move(other));
  }
  const double width_over_height = double(size.width) / size.height;
  ProgressBar bar("frames", std::size_t(frames));
  const auto advance = [&] { bar.advance(); };
  if (flat) {
    const FlatFigure figure(drawing);
    const Camera camera = figure.camera(shown, width_over_height);
    const CutOutPainter painter = figure.painterFor(camera, size.height);
    const auto paint = [&](int frame) {
      return figure.paint(clip, frame / film.frame_rate, camera, painter, film);
    };
    writeFrames(frames, true, paint, *video, advance);
  } else {
    const Scene scene(file.character, painterFor(options.painter, file.character.mesh));
    const Camera camera = filmCamera(file.character, shown, options.angle_deg * std::numbers::pi / 180,
                                     options.pitch_deg * std::numbers::pi / 180, width_over_height);
    writeFilm(scene, clip, camera, film, *video, advance);
  }
  video->finish();
  std::printf("%s: %d frames of %dx%d, %.2f s of \"%s\"\n", options.output.c_str(), frames, size.width,
              size.height, frames / options.frame_rate, clip.name.c_str());
  return ExitCode::kDone;
}

}  // namespace skel
