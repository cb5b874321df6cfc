#include "stylizer/puppet_film.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/draw_triangles.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/style/align_phases.h"

namespace skel {
namespace {

constexpr double kMargin = 0.05;  // around the figure, of the long side
constexpr std::size_t kBatch = 8;

// The drawing without its figure: each row goes on from what is left of the figure to what is right of it.
Image withoutFigure(const Image& image, const Plane8& mask) {
  Image result = image;
  constexpr int kRim = 3;  // px around the mask that have colours of the figure
  for (int y = 0; y < image.height; ++y) {
    const auto near = [&](int x) {
      for (int dy = -kRim; dy <= kRim; ++dy)
        for (int dx = -kRim; dx <= kRim; ++dx) {
          const int px = x + dx, py = y + dy;
          if (px >= 0 && py >= 0 && px < image.width && py < image.height && mask(py, px) > 0) return true;
        }
      return false;
    };
    for (int x = 0; x < image.width; ++x) {
      if (!near(x)) continue;
      int end = x;
      while (end < image.width && near(end)) ++end;
      const int a = x > 0 ? x - 1 : std::min(end, image.width - 1), b = end < image.width ? end : a;
      for (int i = x; i < end; ++i)
        for (int c = 0; c < 4; ++c) {
          const double t = double(i - x + 1) / (end - x + 1);
          result.pixel(i, y)[c] =
              std::uint8_t(std::lround((1 - t) * image.pixel(a, y)[c] + t * image.pixel(b, y)[c]));
        }
      x = end;
    }
  }
  return result;
}

Color colorOf(const std::string& text) {
  if (text == "white") return kWhite;
  if (text == "black") return {0, 0, 0};
  if (text == "none") return kClear;
  unsigned value = 0;
  const auto parsed = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (text.size() != 7 || parsed.ptr != text.data() + text.size())
    throw UsageError("--background is \"" + text + "\"; a colour is written #rrggbb");
  return {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

// Scaled to cover the size, its middle in the middle.
Image covered(const Image& picture, int width, int height) {
  const double scale = std::max(double(width) / picture.width, double(height) / picture.height);
  const Image scaled = resized(picture, std::max(width, int(std::lround(scale * picture.width))),
                               std::max(height, int(std::lround(scale * picture.height))));
  Image result = blankImage(width, height);
  blit(result, scaled, (width - scaled.width) / 2, (height - scaled.height) / 2);
  return result;
}

// The joints at even moments.
PoseMatrix atRate(const PoseMatrix& worn, const std::vector<double>& times_s, double rate,
                  const PuppetFilmOptions& options) {
  const std::size_t m = times_s.size();
  const double first = times_s.front();
  const double step = m > 1 ? (times_s.back() - first) / double(m - 1) : 1 / rate;
  const double cycle_s = times_s.back() - first + step;
  const int count =
      std::max(1, int(std::lround((options.duration_s > 0 ? options.duration_s : cycle_s) * rate)));
  std::vector<double> at;
  for (int i = 0; i < count; ++i) {
    const double t = std::fmod(i / rate + 1e-9, cycle_s) + first;
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), t);
    const std::size_t a = std::size_t(std::max<std::ptrdiff_t>(0, after - times_s.begin() - 1));
    const double end = after == times_s.end() ? first + cycle_s : *after;
    at.push_back(double(a) + std::clamp((t - times_s[a]) / (end - times_s[a]), 0., 1 - 1e-9));
  }
  return posesAt(worn, at, options.loops);
}

}  // namespace

PuppetFrames layOut(const Puppet& puppet, const RiggedDrawing& drawing, const PoseMatrix& worn,
                    const std::vector<double>& times_s, const PuppetFilmOptions& options) {
  PuppetFrames frames;
  frames.frame_rate = options.frame_rate;
  const PoseMatrix poses = atRate(worn, times_s, frames.frame_rate, options);
  frames.vertices.resize(std::size_t(poses.cols()));
  std::vector<int> flipped(frames.vertices.size());
  parallelFor(frames.vertices.size(), 0, [&](std::size_t i) {
    frames.vertices[i] = posedVertices(puppet, poses.col(Eigen::Index(i)));
    flipped[i] = flippedTriangles(puppet.vertices, frames.vertices[i], puppet.triangles);
  });
  for (const int count : flipped) frames.flipped += count;
  const bool keep = options.background == "keep";
  Eigen::RowVector2d low = frames.vertices[0].colwise().minCoeff(),
                     high = frames.vertices[0].colwise().maxCoeff();
  for (const Eigen::MatrixX2d& v : frames.vertices) {
    low = low.cwiseMin(v.colwise().minCoeff());
    high = high.cwiseMax(v.colwise().maxCoeff());
  }
  const double margin = kMargin * (high - low).maxCoeff();
  low.array() -= margin;
  high.array() += margin;
  if (keep) {
    low = Eigen::RowVector2d::Zero();
    high = Eigen::RowVector2d(drawing.image.width - 1, drawing.image.height - 1);
  }
  const Eigen::RowVector2d extent = high - low;
  frames.scale = std::min(options.size_px / extent.maxCoeff(), 4.);
  frames.corner = low.transpose();
  const auto even = [](double side) { return std::max(2, 2 * int(std::lround(side / 2))); };
  frames.width = even(frames.scale * extent.x());
  frames.height = even(frames.scale * extent.y());
  if (keep) {
    frames.background =
        resized(withoutFigure(drawing.image, drawing.silhouette.mask), frames.width, frames.height);
  } else if (options.background.starts_with('#') || options.background == "white" ||
             options.background == "black" || options.background == "none") {
    frames.background = blankImage(frames.width, frames.height, colorOf(options.background));
  } else {
    frames.background = covered(readImage(options.background), frames.width, frames.height);
  }
  return frames;
}

Image paintFrame(const Puppet& puppet, const PuppetFrames& frames, std::size_t i) {
  Image image = frames.background;
  const Eigen::MatrixX2d places =
      ((frames.vertices[i].rowwise() - frames.corner.transpose()).array() * frames.scale).matrix();
  drawTriangles(image, places, puppet.triangles, puppet.texture, puppet.texture_places);
  return image;
}

void writePuppetFilm(const Puppet& puppet, const PuppetFrames& frames, VideoWriter& video,
                     const std::function<void()>& on_frame) {
  for (std::size_t first = 0; first < frames.vertices.size(); first += kBatch) {
    std::vector<Image> batch(std::min(kBatch, frames.vertices.size() - first));
    parallelFor(batch.size(), 0, [&](std::size_t i) { batch[i] = paintFrame(puppet, frames, first + i); });
    for (const Image& image : batch) {
      video.add(image);
      on_frame();
    }
  }
}

RiggedDrawing rigPerformer(const std::string& path) {
  if (path.ends_with(".glb"))
    throw InputError(path, "is a 3D character: make a clip by --to-clip, and play it by skel-animate render");
  return rigDrawing(path, "biped");
}

}  // namespace skel
