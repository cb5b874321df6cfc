#include "animator/render_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "libskel/cli/names.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/video/video_writer.h"

namespace skel {

namespace {

// Film or sheet: one of both. Returns --sheet, for options that only films have.
CLI::Option* bindSheetOptions(CLI::App& app, CLI::Option* film, SheetOptions& options) {
  CLI::Option* sheet =
      app.add_option("--sheet", options.output,
                     "Instead of films, a sprite sheet (.png) and where its frames are (.json); of several "
                     "drawings, a folder")
          ->check(outputFile())
          ->excludes(film);
  const auto add = [&](CLI::Option* option) { return option->group("Sprite sheets")->needs(sheet); };
  sheet->group("Sprite sheets");
  add(app.add_option("--directions", options.directions,
                     "Sides that the figure looks to: 1 as it is drawn, 2 left and right, 4, 8 or 16")
          ->check(oneOfNumbers({1, 2, 4, 8, 16}))
          ->capture_default_str());
  add(app.add_option("--frames", options.most_frames, "Of one clip at most; 0: as many as --fps gives")
          ->check(numberIn(0, 1000))
          ->capture_default_str());
  add(app.add_option("--atlas", options.atlas,
                     "The frames in the .json: array, hash (by name), or aseprite (hash by number)")
          ->check(CLI::IsMember({"array", "hash", "aseprite"}))
          ->capture_default_str());
  CLI::Option* same_scale = add(
      app.add_flag("--same-scale", options.same_scale,
                   "Of several drawings: a metre is as many pixels in all sheets, and all pivots are one"));
  add(app.add_option("--like", options.like,
                     "The .json of a sheet that is there: its size, scale and pivot are taken")
          ->type_name("SHEET.json")
          ->check(pickedFiles()))  // it may be made again
      ->excludes(same_scale);
  add(app.add_flag("--trim", options.trim, "What is clear around a frame is cut off, frames lie close"));
  CLI::Option* pixels =
      add(app.add_flag("--pixels", options.pixels, "As pixel artists draw: no mixed colours, hard edges"));
  add(app.add_option("--palette", options.palette,
                     "Of so many colours at most, in the whole sheet, or those of a picture, such as a sheet "
                     "that is there")
          ->type_name("N|PICTURE")
          ->check(
              [](std::string text) { return isCount(text) ? zeroOrNumberIn(2, 256)(text) : std::string(); })
          ->check(pickedFiles()))  // it may be made again
      ->needs(pixels);
  add(app.add_flag("--outline", options.outline, "A dark line of one pixel around the figure"))
      ->needs(pixels);
  return sheet;
}

}  // namespace

void bindRenderOptions(CLI::App& app, RenderCommandOptions& options) {
  app.add_option("file", options.files,
                 "Rigged characters (.glb), drawings, which are rigged first, folders of drawings, or models "
                 "(.obj) with --skeleton")
      ->required()
      ->type_name("FILE");
  bindCharacterOptions(app, options.source);
  app.add_option(
         "--clip,--clips", options.clips,
         "Clips of the file, those that come with skel, or files (.clip.json, .bvh, key frames), with "
         "commas in between; or all")
      ->required()
      ->delimiter(',')
      ->transform(withoutBlanks())
      ->allow_extra_args(false);
  CLI::Option* film =
      app.add_option(
             "-o,--output", options.output,
             "The film: " + videoFormatNames() +
                 " (a name that ends with /) of PNG files; of several drawings one film of all, or a folder "
                 "of films; of several clips a folder")
          ->check(outputFile());
  CLI::Option* sheet = bindSheetOptions(app, film, options.sheet);
  CLI::Option* together =
      app.add_flag("--together", options.together,
                   "One film of all drawings, side by side, also where -o is a folder, which is then of PNG "
                   "files")
          ->excludes(sheet);
  app.add_flag("--names", options.names, "In a film of several drawings: what they are called, below each")
      ->excludes(sheet);
  app.add_option("--format", options.format,
                 "Of the films in a folder, which are called FILE-CLIP (default: " + filmFormats().front() +
                     "); png: folders of PNG files")
      ->check(CLI::IsMember(filmFormats()))
      ->excludes(sheet)
      ->excludes(together);
  app.add_option("--fps", options.frame_rate, "Frames a second (default: 30, of sheets 12)")
      ->check(numberIn(0.1, 240.0));
  bindClipSource(app, options.library);
  app.add_option("--duration", options.duration_s, "In seconds; the clip repeats (default: once)")
      ->check(numberIn(0.01, 3600.0))
      ->excludes(sheet);
  app.add_option(
         "--look", options.look,
         "solid: the model; flat: the drawing itself, its limbs moved in the picture, unlit; auto: "
         "flat for a drawing of a person whose joints are no guess, unless something is asked for that only "
         "a model has")
      ->check(CLI::IsMember({"auto", "solid", "flat"}))
      ->capture_default_str();
  app.add_option("--size", options.size,
                 "WIDTHxHEIGHT, or one number for both, px (default: 512, of a film of several drawings "
                 "1920x1080, of a sheet's frames 64)");
  addNamedNumbers(
      app, "--angle", options.angles, numberIn(-360.0, 360.0),
      "From where it is seen: 0 from the front, 90 from its left, degrees; of several, NAME=DEGREES "
      "is of one alone, with commas in between: 0,cat=90 (default: 0)");
  app.add_option("--pitch", options.pitch_deg, "How far from above, degrees")
      ->check(numberIn(-89.0, 89.0))
      ->capture_default_str();
  app.add_option("--frame", options.frame,
                 "What the camera shows all of: each clip by itself, or all clips of the character, so that "
                 "its films have one scale and one ground; auto: clips where several are asked for "
                 "in films; a sheet's clips share a scale anyway")
      ->check(CLI::IsMember({"auto", "clip", "clips"}))
      ->capture_default_str();
  app.add_option("--background", options.background,
                 "white, grey, black, #rrggbb, none (transparent), or a picture")
      ->excludes(sheet)
      ->capture_default_str();
  app.add_flag("--wireframe", options.wireframe, "The mesh's edges as well")->excludes(sheet);
  app.add_flag("--translucent", options.translucent, "The body can be seen through")->excludes(sheet);
  app.add_flag("--show-skeleton", options.skeleton, "The skeleton over the body")->excludes(sheet);
  app.add_option("--show-weights", options.weights_of, "The weights of this joint as colours")
      ->excludes(sheet)
      ->type_name("JOINT");
  app.add_flag("--no-shadow", options.no_shadow, "No shadow on the ground")->excludes(sheet);
  app.add_flag("--no-ink", options.no_ink,
               "Without the line around the model that goes on from the drawing's own outline");
  app.add_option("--blend", options.blend, "How joints move the skin: matrices, or dual quaternions")
      ->check(CLI::IsMember({"linear", "dual"}))
      ->excludes(sheet)
      ->capture_default_str();
  app.add_option("--painter", options.painter, "What draws: auto takes a graphics card if there is one")
      ->check(CLI::IsMember({"auto", "software", "gl"}))
      ->capture_default_str();
}

bool manyClips(const RenderCommandOptions& options) {
  return options.clips.size() > 1 || options.clips.front() == kAllClips;
}

bool needsModel(const RenderCommandOptions& options, bool turned) {
  return turned || options.wireframe || options.translucent || !options.weights_of.empty();
}

std::vector<std::string> filmFormats() {
  std::vector<std::string> names;
  for (const char* name : {"mp4", "gif", "webp"})
    if (videoFormatNames().find(name) != std::string::npos) names.emplace_back(name);
  names.emplace_back("png");
  return names;
}

PictureSize sizeOf(const RenderCommandOptions& options, PictureSize otherwise) {
  if (options.size.empty()) return otherwise;
  PictureSize size;
  const char *begin = options.size.data(), *end = begin + options.size.size();
  const auto width = std::from_chars(begin, end, size.width);
  if (width.ec == std::errc() && width.ptr == end && size.width > 0) return {size.width, size.width};
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc() && height.ptr == end && size.width > 0 && size.height > 0) return size;
  }
  throw UsageError("--size is \"" + options.size + "\", must be WIDTHxHEIGHT in px, such as 512x512, or 512");
}

std::unique_ptr<MeshPainter> painterFor(const RenderCommandOptions& options, const TriangleMesh& mesh) {
  if (options.painter == "gl") return offscreenPainter(mesh);
  return options.painter == "software" ? softwarePainter(mesh) : fastestPainter(mesh);
}

}  // namespace skel
