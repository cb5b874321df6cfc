#include "stylizer/film_figure.h"

#include <algorithm>

#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {
namespace {

constexpr std::size_t kBackgroundFrames = 25, kLeastBackgroundFrames = 3, kBatch = 16;
constexpr std::size_t kPixelsAtOnce = 100'000'000;  // of all frames that are in memory together
// A figure that stands in the median of all frames is one that does not leave its place.
constexpr double kStandingShare = 0.3;

std::size_t framesAtOnce(const FilmInfo& info, std::size_t least, std::size_t most) {
  const std::size_t pixels = std::size_t(info.width) * std::size_t(info.height);
  return std::clamp(kPixelsAtOnce / std::max<std::size_t>(1, pixels), least, most);
}

double areaOf(const Silhouette& silhouette) {
  return silhouette.found() ? double((silhouette.mask > 0).count()) : 0;
}

}  // namespace

FilmInfo lookAtFilm(const FilmSource& source, Image& background) {
  const auto reader = readVideo(source.path, source.frame_rate);
  FilmInfo info;
  info.frame_rate = reader->frameRate();
  // Of a film of unknown length, every second sample is dropped whenever there are twice too many.
  std::vector<Image> samples;
  int every = std::max(1, reader->frameCount() / int(kBackgroundFrames));
  VideoFrame frame;
  const bool by_alpha = source.figure == "auto" || source.figure == "alpha";
  bool transparent = false;
  info.method = source.figure == "silhouette" ? FigureMethod::kSilhouette : FigureMethod::kStill;
  for (; reader->next(frame); ++info.frames) {
    info.width = frame.image.width;
    info.height = frame.image.height;
    if (by_alpha && !transparent && hasTransparency(frame.image)) {
      transparent = true;
      info.method = FigureMethod::kAlpha;
      if (reader->frameCount() > 0) {
        info.frames = reader->frameCount();
        break;
      }
    }
    if (info.method != FigureMethod::kStill || info.frames % every != 0) continue;
    samples.push_back(frame.image);
    if (samples.size() < framesAtOnce(info, 2 * kLeastBackgroundFrames - 1, 2 * kBackgroundFrames)) continue;
    for (std::size_t i = 0; 2 * i < samples.size(); ++i) samples[i] = std::move(samples[2 * i]);
    samples.resize((samples.size() + 1) / 2);
    every *= 2;
  }
  if (source.figure == "alpha" && !transparent)
    throw InputError(source.path, "has no transparency in any frame; use another --figure");
  if (info.method != FigureMethod::kStill) return info;
  background = stillBackground(samples);
  if (source.figure == "auto" &&
      (samples.size() < 3 ||
       areaOf(extractSilhouette(background)) > kStandingShare * areaOf(extractSilhouette(samples[0]))))
    info.method = FigureMethod::kSilhouette;
  return info;
}

void forEachFrame(const FilmSource& source, const FilmInfo& info, const Image& background,
                  const std::function<void(std::size_t, FilmFrame&)>& work) {
  const auto reader = readVideo(source.path, source.frame_rate);
  std::size_t first = 0;
  for (bool more = true; more;) {
    std::vector<FilmFrame> batch;
    while (batch.size() < framesAtOnce(info, 1, kBatch)) {
      FilmFrame frame;
      more = reader->next(frame.video) && first + batch.size() < std::size_t(info.frames);
      if (!more) break;
      batch.push_back(std::move(frame));
    }
    parallelFor(batch.size(), 0, [&](std::size_t i) {
      FilmFrame& frame = batch[i];
      const Image& image = frame.video.image;
      if (info.method == FigureMethod::kAlpha) {
        frame.figure = opaquePart(image, source.foreground);
      } else if (info.method == FigureMethod::kStill) {
        frame.figure = foreground(image, background, source.foreground);
      } else {
        frame.figure = extractSilhouette(image).mask;
        if (frame.figure.size() == 0) frame.figure = Plane8::Zero(image.height, image.width);
      }
      work(first + i, frame);
    });
    first += batch.size();
  }
}

}  // namespace skel
