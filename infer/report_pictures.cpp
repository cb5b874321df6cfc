#include "infer/report_pictures.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "libskel/animation/sample_pose.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/write_image.h"
#include "libskel/image/write_jpeg.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

constexpr int kDrawingWidth = 400, kDrawingHeight = 480;  // px, at most
constexpr int kColumns = 8, kMostRows = 5;
constexpr double kFrameRate = 10;  // 1/s

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string dataAddress(const Image& picture) {
  constexpr int kQuality = 78;
  const auto jpeg = encodeJpeg(picture, kQuality);
  return jpeg ? "data:image/jpeg;base64," + base64(*jpeg)
              : "data:image/png;base64," + base64(encodePng(picture, 9));
}

const Clip* shownClip(const std::vector<Clip>& clips, const std::string& wanted) {
  for (const std::string_view name :
       {std::string_view(wanted), std::string_view("dance"), std::string_view("walk")})
    for (const Clip& clip : clips)
      if (clip.name == name) return &clip;
  return clips.empty() ? nullptr : &clips.front();
}

FilmSheet filmSheet(const RiggedDrawing& drawing, const Clip& clip) {
  const RiggedCharacter& character = drawing.character;
  const double yaw_rad = drawing.body_plan.from_side ? 0 : .35;
  constexpr double kPitch_rad = .08;
  FilmSheet film;
  film.columns = kColumns;
  film.duration_s = double(clip.duration_s());
  film.rows = std::clamp(int(std::lround(film.duration_s * kFrameRate / kColumns)), 1, kMostRows);
  const int count = film.rows * film.columns;

  const Eigen::Index vertices = character.mesh.vertices.rows();
  const auto heights = character.mesh.vertices.col(1);
  Eigen::MatrixX3f all(vertices * (count + 1), 3);
  all.bottomRows(vertices) = character.mesh.vertices;
  for (int i = 0; i < count; ++i) {
    const float time_s = clip.duration_s() * float(i) / float(count);
    all.middleRows(i * vertices, vertices) =
        skinVertices(character.mesh.vertices, character.weights,
                     posedFromRest(character.skeleton, samplePose(clip, character.skeleton, time_s),
                                   heights.maxCoeff() - heights.minCoeff()));
  }
  const Camera camera = framingCamera(all, yaw_rad, kPitch_rad, double(kFilmWidth) / kFilmHeight);
  const auto frame = [&](int i) {
    return renderMesh(all.middleRows(i * vertices, vertices), character.mesh, camera,
                      {.width = kFilmWidth, .height = kFilmHeight});
  };
  Image sheet = blankImage(film.columns * kFilmWidth, film.rows * kFilmHeight);
  for (int i = 0; i < count; ++i)
    blit(sheet, frame(i), i % film.columns * kFilmWidth, i / film.columns * kFilmHeight);
  film.source = dataAddress(sheet);
  Image rest = blankImage(kFilmWidth, kFilmHeight);
  blit(rest, frame(count), 0, 0);
  film.rest = dataAddress(rest);
  return film;
}

// With a margin.
Image aroundFigure(const Image& image, const Plane8& mask) {
  constexpr double kMargin = 0.12;  // of the figure's long side
  const PixelBox box = figureBox(mask);
  if (box.width() == 0) return image;
  const int margin = int(std::lround(kMargin * std::max(box.width(), box.height())));
  const int x0 = std::max(0, box.x0 - margin), y0 = std::max(0, box.y0 - margin);
  Image part(std::min(image.width, box.x1 + margin) - x0, std::min(image.height, box.y1 + margin) - y0);
  for (int y = 0; y < part.height; ++y)
    std::copy_n(image.pixel(x0, y0 + y), 4 * std::size_t(part.width), part.pixel(0, y));
  return part;
}

}  // namespace

std::string reportPicture(const Image& drawing) {
  Image paper = blankImage(drawing.width, drawing.height);
  blit(paper, drawing, 0, 0);
  return dataAddress(fitted(paper, kDrawingWidth, kDrawingHeight));
}

ReportPictures reportPictures(const RiggedDrawing& drawing, const std::string& clip, bool figure_alone) {
  ReportPictures pictures;
  pictures.drawing =
      reportPicture(figure_alone ? aroundFigure(drawing.image, drawing.silhouette.mask) : drawing.image);
  if (const Clip* shown = shownClip(drawing.clips, clip)) pictures.film = filmSheet(drawing, *shown);
  return pictures;
}

}  // namespace skel
