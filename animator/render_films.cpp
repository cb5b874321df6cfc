#include "animator/render_films.h"

#include <cstdio>
#include <filesystem>
#include <numbers>

#include "animator/film.h"
#include "animator/flat_figure.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

bool manyClips(const RenderCommandOptions& options) {
  return options.clips.size() > 1 || options.clips.front() == kAllClips;
}

// Where films go.
struct FilmNames {
  std::string output, format;
  bool in_folder;  // the output is a folder of films

  std::string operator()(const std::string& character, const std::string& clip) const {
    if (!in_folder) return output;
    const fs::path path = fs::path(output) / safeFileName(character + "-" + clip);
    return path.string() + (format == "png" ? "/" : "." + format);
  }
};

FilmNames filmNames(const RenderCommandOptions& options) {
  const bool several = options.files.size() > 1 || manyClips(options);
  if (options.output.empty()) throw UsageError("name the film by -o, or a sprite sheet by --sheet");
  FilmNames names{options.output, options.format.empty() ? filmFormats().front() : options.format,
                  several || !options.format.empty()};
  if (names.in_folder && !options.output.ends_with('/') && !fs::is_directory(options.output))
    throw UsageError(options.output + " must be a folder (a name that ends with /): " +
                     (several ? "there are several films" : "--format is that of films in a folder"));
  return names;
}

FilmOptions filmOptions(const RenderCommandOptions& options) {
  const PictureSize size = sizeOf(options, {512, 512});
  FilmOptions film;
  film.width = size.width;
  film.height = size.height;
  film.frame_rate = options.frame_rate.value_or(30);
  film.duration_s = options.duration_s;
  film.look.wireframe = options.wireframe;
  film.look.translucent = options.translucent;
  film.look.skeleton = options.skeleton;
  film.look.shadow = !options.no_shadow;
  if (options.blend == "dual") film.look.blending = Blending::kDualQuaternions;
  if (const auto color = backgroundColor(options.background))
    film.look.background = *color;
  else
    film.look.picture = readImage(options.background);
  return film;
}

struct Films {
  const RenderCommandOptions& options;
  FilmNames names;
  FilmOptions film;
  VideoOptions video;

  explicit Films(const RenderCommandOptions& asked)
      : options(asked), names(filmNames(asked)), film(filmOptions(asked)) {
    if (options.look == "flat" && needsModel(options))
      throw UsageError(
          "--look flat shows the drawing as it was drawn: leave out --angle, --wireframe, --translucent and "
          "--show-weights");
    video = {.width = film.width, .height = film.height, .frame_rate = film.frame_rate};
    video.transparent = film.look.background.a < 255 && film.look.picture.empty();
    if (names.in_folder && names.format == "mp4" && video.transparent)
      throw UsageError(options.output + ": films in a folder are MP4, which has no transparency, unless " +
                       "--format webp, gif or png is given; or give a background");
    if (!names.in_folder)
      openVideo(options.output, video);
    else if (ensureWritableFolder(options.output); names.format != "png")
      openVideo(names("film", "clip"), video);
    checkVideo(video);
    if (!film.look.picture.empty()) film.look.picture = covering(film.look.picture, film.width, film.height);
  }

  Camera cameraOf(const RiggedCharacter& character, const std::vector<Clip>& clips) const {
    return filmCamera(character, clips, options.angle_deg * std::numbers::pi / 180,
                      options.pitch_deg * std::numbers::pi / 180, double(film.width) / film.height);
  }

  // `frames(video, on_frame)` writes them all.
  template <class Frames>
  void write(const Clip& clip, const std::string& path, const Frames& frames) const {
    VideoOptions clip_video = video;
    clip_video.frames = frameCount(clip, film);
    const auto writer = openVideo(path, clip_video);
    {
      ProgressBar bar("frames", std::size_t(clip_video.frames));
      frames(*writer, [&] { bar.advance(); });
      writer->finish();
    }
    // Who has not asked for pictures may have wanted a film.
    const char* hint = !fs::is_directory(path)  ? ""
                       : options.format.empty() ? ", as PNG files (a film: -o NAME.mp4)"
                                                : ", as PNG files";
    std::printf("%s: %d frames of %dx%d, %.2f s of \"%s\"%s\n", printable(path).c_str(), clip_video.frames,
                film.width, film.height, clip_video.frames / film.frame_rate, printable(clip.name).c_str(),
                hint);
  }

  void writeFlat(const FlatFigure& figure, const Clip& clip, const Camera& camera,
                 const std::string& path) const {
    const CutOutPainter painter = figure.painterFor(camera, film.height);
    const auto paint = [&](int frame) {
      return figure.paint(clip, frame / film.frame_rate, camera, painter, film);
    };
    write(clip, path, [&](VideoWriter& writer, const auto& on_frame) {
      writeFrames(frameCount(clip, film), true, paint, writer, on_frame);
    });
  }

  void operator()(CharacterFile file, const RiggedDrawing* flat, const std::vector<Clip>& clips) const {
    const RiggedCharacter& character = file.character;
    Look look = film.look;
    if (!options.weights_of.empty()) {
      look.weights_of = character.skeleton.find(options.weights_of);
      if (look.weights_of < 0)
        throw UsageError("--show-weights: there is no joint \"" + options.weights_of + "\" in " + file.name);
    }
    std::vector<std::string> paths;
    for (const Clip& clip : clips) {
      paths.push_back(names(file.name, clip.name));
      if (names.in_folder) noteNamedOutput(paths.back());
    }
    const bool one_camera = options.frame == "clips" || (options.frame == "auto" && manyClips(options));
    if (one_camera) {
      ClipSource library = options.library;
      library.flat = flat != nullptr;
      addLibrary(file, library);
      file.clips.insert(file.clips.end(), clips.begin(), clips.end());
    }
    const auto shownWith = [&](const Clip& clip) {
      return one_camera ? file.clips : std::vector<Clip>{clip};
    };
    if (flat) {
      const FlatFigure figure(*flat);
      for (std::size_t i = 0; i < clips.size(); ++i)
        writeFlat(figure, clips[i], figure.camera(shownWith(clips[i]), double(film.width) / film.height),
                  paths[i]);
      return;
    }
    FilmOptions shown = film;
    shown.look = look;
    const Scene scene(character, painterFor(options, character.mesh));
    for (std::size_t i = 0; i < clips.size(); ++i)
      write(clips[i], paths[i], [&](VideoWriter& writer, const auto& on_frame) {
        writeFilm(scene, clips[i], cameraOf(character, shownWith(clips[i])), shown, writer, on_frame);
      });
  }
};

}  // namespace

CharacterRenderer filmRenderer(const RenderCommandOptions& options) { return {Films(options)}; }

}  // namespace skel
