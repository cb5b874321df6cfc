#include "stylizer/puppet_film.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/parallel.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
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

Image on(const Color& color, const Image& image) {
  Image ground = blankImage(image.width, image.height, color);
  blit(ground, image, 0, 0);
  return ground;
}

// The joints at even moments.
PoseMatrix atRate(const PoseMatrix& worn, const std::vector<double>& times_s, double rate,
                  const PuppetFilmOptions& options) {
  const double first = times_s.front(), cycle_s = motionLength_s(times_s, rate);
  const int count = std::max(1, int(std::lround(options.duration_s * rate)));
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

FilmBackground readBackground(const std::string& text) {
  if (text == "keep") return {true, kWhite, {}};
  if (const auto color = backgroundColor(text)) return {false, *color, {}};
  return {false, kWhite, readImage(text)};
}

FilmBackground keptBackground(const Image& drawing, const std::string& output) {
  const bool transparent = (drawing.rgba.col(3) < 255).any();
  return {true, transparent && keepsTransparency(output) ? kClear : kWhite, {}};
}

double motionLength_s(const std::vector<double>& times_s, double rate) {
  const std::size_t m = times_s.size();
  const double way_s = times_s.back() - times_s.front();
  return way_s + (m > 1 ? way_s / double(m - 1) : 1 / rate);
}

PuppetFrames layOut(const Puppet& puppet, const Performer& performer, const PoseMatrix& worn,
                    const std::vector<double>& times_s, const PuppetFilmOptions& options) {
  PuppetFrames frames;
  frames.frame_rate = options.frame_rate;
  frames.poses = atRate(worn, times_s, frames.frame_rate, options);
  // What a frame needs is kept, not where its vertices are: films are long.
  struct Extent {
    Eigen::RowVector2d low, high;
    double torn = 0;
  };
  std::vector<Extent> extents(std::size_t(frames.poses.cols()));
  parallelFor(extents.size(), 0, [&](std::size_t i) {
    Extent& extent = extents[i];
    extent.low.setConstant(1e300), extent.high.setConstant(-1e300);
    for (const Eigen::MatrixX2d& sheet :
         posedSheets(puppet, frames.poses.col(Eigen::Index(i)), &extent.torn)) {
      extent.low = extent.low.cwiseMin(sheet.colwise().minCoeff());
      extent.high = extent.high.cwiseMax(sheet.colwise().maxCoeff());
    }
  });
  Eigen::RowVector2d low = extents[0].low, high = extents[0].high;
  for (const Extent& extent : extents) {
    low = low.cwiseMin(extent.low);
    high = high.cwiseMax(extent.high);
    frames.torn = std::max(frames.torn, extent.torn);
  }
  const double margin = kMargin * (high - low).maxCoeff();
  low.array() -= margin;
  high.array() += margin;
  if (options.background.keep) {
    low = Eigen::RowVector2d::Zero();
    high = Eigen::RowVector2d(performer.image.width - 1, performer.image.height - 1);
  }
  const Eigen::RowVector2d extent = high - low;
  frames.scale = std::min(options.size_px / extent.maxCoeff(), 4.);
  frames.corner = low.transpose();
  const auto even = [](double side) { return std::max(2, 2 * int(std::lround(side / 2))); };
  frames.width = even(frames.scale * extent.x());
  frames.height = even(frames.scale * extent.y());
  if (options.background.keep) {
    const Image drawing =
        options.background.isTransparent() ? performer.image : on(options.background.color, performer.image);
    frames.background =
        resized(withoutFigure(drawing, performer.silhouette.mask), frames.width, frames.height);
  } else if (options.background.picture.empty()) {
    frames.background = blankImage(frames.width, frames.height, options.background.color);
  } else {
    frames.background = covering(options.background.picture, frames.width, frames.height);
  }
  return frames;
}

CutOutPainter painterFor(const Puppet& puppet, const PuppetFrames& frames) {
  return CutOutPainter(puppet.cut_out, frames.scale / puppet.model_from_image.scale.x());
}

Image paintFrame(const Puppet& puppet, const CutOutPainter& painter, const PuppetFrames& frames,
                 std::size_t i) {
  Image image = frames.background;
  std::vector<Eigen::MatrixX2d> places = posedSheets(puppet, frames.poses.col(Eigen::Index(i)));
  for (Eigen::MatrixX2d& sheet : places)
    sheet = ((sheet.rowwise() - frames.corner.transpose()).array() * frames.scale).matrix();
  painter.paint(places, image);
  return image;
}

void writePuppetFilm(const Puppet& puppet, const PuppetFrames& frames, VideoWriter& video,
                     const std::function<void()>& on_frame) {
  const std::size_t count = std::size_t(frames.poses.cols());
  const CutOutPainter painter = painterFor(puppet, frames);
  for (std::size_t first = 0; first < count; first += kBatch) {
    std::vector<Image> batch(std::min(kBatch, count - first));
    parallelFor(batch.size(), 0,
                [&](std::size_t i) { batch[i] = paintFrame(puppet, painter, frames, first + i); });
    for (const Image& image : batch) {
      video.add(image);
      on_frame();
    }
  }
}

}  // namespace skel
