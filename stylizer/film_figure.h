// The figure in each frame of a film.
#pragma once

#include <functional>
#include <string>

#include "libskel/video/figure_in_frame.h"
#include "libskel/video/video_reader.h"

namespace skel {

struct FilmSource {
  std::string path;               // a film, or a folder of pictures
  double frame_rate = 12;         // of a folder, 1/s
  bool frame_rate_given = false;  // by the user
  std::string figure = "auto";    // auto, alpha, still, silhouette
  ForegroundOptions foreground;
};
enum class FigureMethod {
  kAlpha,       // what is not transparent
  kStill,       // what differs from a background that stands still
  kSilhouette,  // stage 2 of the pipeline, for each frame
};

struct FilmInfo {
  double frame_rate = 0;  // 1/s
  int frames = 0;
  int width = 0, height = 0;  // px
  FigureMethod method = FigureMethod::kAlpha;
};

struct FilmFrame {
  VideoFrame video;
  Plane8 figure;  // 255 on the figure; all 0 where there is none
};

// Which method, and how many frames: reads the film once unless its frames are transparent and counted. By
// `auto`: their alpha if any frame has some; else a still background, unless the figure itself stands in it,
// as one does that walks on the spot; then the silhouette. Throws InputError.
FilmInfo lookAtFilm(const FilmSource& source, Image& background);

// work(i, frame) for each frame, several at once, in batches; `background` as lookAtFilm() found it.
void forEachFrame(const FilmSource& source, const FilmInfo& info, const Image& background,
                  const std::function<void(std::size_t, FilmFrame&)>& work);

}  // namespace skel
