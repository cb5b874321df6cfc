#include "animator/render_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/video/video_writer.h"

namespace skel {

void bindRenderOptions(CLI::App& app, RenderCommandOptions& options) {
  app.add_option(
         "file", options.files,
         "Rigged characters (.glb), drawings, which are rigged first, or models (.obj) with --skeleton")
      ->required()
      ->type_name("FILE");
  bindCharacterOptions(app, options.source);
  app.add_option(
         "--clip,--clips", options.clips,
         "Clips of the file, those that come with skel, or files (.clip.json, .bvh, key frames), with "
         "commas in between; or all")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option(
         "-o,--output", options.output,
         "The film: " + videoFormatNames() +
             " (a name that ends with /) of PNG files; of several drawings or clips, a folder of films")
      ->required()
      ->check(outputFile());
  app.add_option("--format", options.format,
                 "Of the films in a folder, which are called FILE-CLIP (default: " + filmFormats().front() +
                     "); png: folders of PNG files")
      ->check(CLI::IsMember(filmFormats()));
  app.add_option("--fps", options.frame_rate, "Frames a second")
      ->check(numberIn(0.1, 240.0))
      ->capture_default_str();
  bindClipSource(app, options.library);
  app.add_option("--duration", options.duration_s, "In seconds; the clip repeats (default: once)")
      ->check(numberIn(0.0, 3600.0));
  app.add_option("--size", options.size, "WIDTHxHEIGHT, px")->capture_default_str();
  app.add_option("--angle", options.angle_deg,
                 "From where it is seen: 0 from the front, 90 from its left, degrees")
      ->check(numberIn(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--pitch", options.pitch_deg, "How far from above, degrees")
      ->check(numberIn(-89.0, 89.0))
      ->capture_default_str();
  app.add_option("--frame", options.frame,
                 "What the camera shows all of: each clip by itself, or all clips of the character, so that "
                 "its films have one scale and one ground; auto: clips where several are asked for")
      ->check(CLI::IsMember({"auto", "clip", "clips"}))
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

std::vector<std::string> filmFormats() {
  std::vector<std::string> names;
  for (const char* name : {"mp4", "gif", "webp"})
    if (videoFormatNames().find(name) != std::string::npos) names.emplace_back(name);
  names.emplace_back("png");
  return names;
}

PictureSize sizeOf(const RenderCommandOptions& options) {
  PictureSize size;
  const char *begin = options.size.data(), *end = begin + options.size.size();
  const auto width = std::from_chars(begin, end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc() && height.ptr == end && size.width > 0 && size.height > 0) return size;
  }
  throw UsageError("--size is \"" + options.size + "\", must be WIDTHxHEIGHT in px, such as 512x512");
}

std::unique_ptr<MeshPainter> painterFor(const RenderCommandOptions& options, const TriangleMesh& mesh) {
  if (options.painter == "gl") return offscreenPainter(mesh);
  return options.painter == "software" ? softwarePainter(mesh) : fastestPainter(mesh);
}

}  // namespace skel
