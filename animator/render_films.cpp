#include "animator/render_films.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "animator/film.h"
#include "animator/group_film.h"
#include "animator/rig_source.h"
#include "animator/stage.h"
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
  if (options.output.empty()) throw UsageError("name the film by -o, or a sprite sheet by --sheet");
  if (options.together && manyClips(options))
    throw UsageError(
        options.output +
        " is one film of all drawings, which shows one clip; for a film of each drawing and clip "
        "name a folder (a name that ends with /)");
  const bool several = manyClips(options) || (options.files.size() > 1 && !options.together);
  FilmNames names{options.output, options.format.empty() ? filmFormats().front() : options.format,
                  several || !options.format.empty()};
  if (names.in_folder && !options.output.ends_with('/') && !fs::is_directory(options.output))
    throw UsageError(options.output + " must be a folder (a name that ends with /): " +
                     (several ? "there are several films" : "--format is that of films in a folder"));
  return names;
}

FilmOptions filmOptions(const RenderCommandOptions& options) {
  const PictureSize size =
      sizeOf(options, options.together ? PictureSize{1920, 1080} : PictureSize{512, 512});
  FilmOptions film;
  film.width = size.width;
  film.height = size.height;
  film.frame_rate = options.frame_rate.value_or(30);
  film.duration_s = options.duration_s;
  film.look.wireframe = options.wireframe;
  film.look.translucent = options.translucent;
  film.look.skeleton = options.skeleton;
  film.look.shadow = !options.no_shadow;
  film.look.ink = !options.no_ink;
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
    const bool turned = std::any_of(options.files.begin(), options.files.end(), [&](const std::string& path) {
      return options.angles(stemOf(path)) != 0;
    });
    if (options.look == "flat" && needsModel(options, turned))
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

  void write(const std::string& path, const std::string& what, int frames, bool concurrent,
             const std::function<Image(int)>& paint) const {
    VideoOptions of_film = video;
    of_film.frames = frames;
    const auto writer = openVideo(path, of_film);
    {
      ProgressBar bar("frames", std::size_t(frames));
      writeFrames(frames, concurrent, paint, *writer, [&] { bar.advance(); });
      writer->finish();
    }
    // Who has not asked for pictures may have wanted a film.
    const char* hint = !fs::is_directory(path)  ? ""
                       : options.format.empty() ? ", as PNG files (a film: -o NAME.mp4)"
                                                : ", as PNG files";
    std::printf("%s: %d %s of %dx%d, %.2f s of %s%s\n", printable(path).c_str(), frames,
                frames == 1 ? "frame" : "frames", film.width, film.height, frames / film.frame_rate,
                printable(what).c_str(), hint);
  }

  bool operator()(const Performer& performer) const {
    std::vector<std::string> paths;
    for (const Clip& clip : performer.clips) {
      paths.push_back(names(performer.file.name, clip.name));
      if (names.in_folder) noteNamedOutput(paths.back());
    }
    const Stage stage(options, performer);
    bool torn = false;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const Clip& clip = performer.clips[i];
      const MomentPainter paint = stage.painterOf(clip, film);
      write(paths[i], '"' + clip.name + '"', frameCount(clip, film), stage.isConcurrent(),
            [&](int frame) { return paint(timeOf(frame, clip, film)); });
      torn |= stage.sayTorn(clip);
    }
    return torn;
  }

  void write(const GroupFilm& group) const {
    if (group.size() == 0) return;
    write(options.output, std::to_string(group.size()) + (group.size() == 1 ? " character" : " characters"),
          group.frameCount(), group.isConcurrent(), [&](int frame) { return group.paint(frame); });
  }
};

}  // namespace

CharacterRenderer filmRenderer(const RenderCommandOptions& options) {
  const Films films(options);
  if (!options.together) return {films};
  const auto group = std::make_shared<GroupFilm>(options, films.film);
  return {.render = [group](Performer one) { return group->add(std::move(one)); },
          .finish = [group, films] { films.write(*group); }};
}

}  // namespace skel
