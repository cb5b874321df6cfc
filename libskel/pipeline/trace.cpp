#include "libskel/pipeline/trace.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "libskel/animation/sample_pose.h"
#include "libskel/core/check.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kMagnification = 5;  // of the working grid
constexpr int kPictureSize = 640;
constexpr int kViewSize = 360;

// Over white, its long side at most `size` px.
Image onPaper(const Image& image, int size = kPictureSize) {
  Image paper = blankImage(image.width, image.height);
  blit(paper, image, 0, 0);
  return fitted(paper, size, size);
}

Vector2d magnified(const Vector2d& grid_point) {
  return ((grid_point.array() + 0.5) * kMagnification - 0.5).matrix();
}

Image silhouettePicture(const RiggedDrawing& drawing) {
  Image picture = onPaper(drawing.image, std::max(drawing.image.width, drawing.image.height));
  drawMask(picture, drawing.silhouette.mask, kLeft.withAlpha(110));
  const double width = std::max(1.0, std::max(picture.width, picture.height) / 250.0);
  for (const Polygon& polygon : drawing.silhouette.outline) drawPolyline(picture, polygon, width, kInk, true);
  return fitted(picture, kPictureSize, kPictureSize);
}

// The figure, and in another colour what joins its pieces.
Image piecesPicture(const RiggedDrawing& drawing) {
  Image picture = onPaper(drawing.image, std::max(drawing.image.width, drawing.image.height));
  drawMask(picture, drawing.silhouette.mask, kLeft.withAlpha(110));
  drawMask(picture, drawing.silhouette.bridges, kRight);
  return fitted(picture, kPictureSize, kPictureSize);
}

Image sharePicture(const Plane8& share) { return onPaper(heatMap(share.cast<float>())); }

Image gridPicture(const RiggedDrawing& drawing) {
  Image picture = blankImage(drawing.silhouette.grid.width, drawing.silhouette.grid.height);
  drawMask(picture, drawing.silhouette.grid_mask, Color{222, 224, 230});
  return magnified(picture, kMagnification);
}

Color candidateColor(const RiggedDrawing& drawing, int i) {
  Eigen::Index best;
  drawing.classes.row(i).maxCoeff(&best);
  return classColor(kJointClassNames[static_cast<size_t>(best)]);
}

Image candidatesPicture(const RiggedDrawing& drawing) {
  Image picture = gridPicture(drawing);
  const auto& maxima = drawing.candidates.maxima;
  for (const int i : drawing.candidates.kept) {
    const JointCandidate& c = maxima[static_cast<size_t>(i)];
    drawCircle(picture, magnified({c.x, c.y}), c.radius * kMagnification, 1.5, candidateColor(drawing, i));
  }
  for (size_t i = 0; i < maxima.size(); ++i) {
    const bool kept = std::binary_search(drawing.candidates.kept.begin(), drawing.candidates.kept.end(),
                                         static_cast<int>(i));
    drawDisc(picture, magnified({maxima[i].x, maxima[i].y}), kept ? 5 : 2,
             candidateColor(drawing, static_cast<int>(i)));
  }
  return picture;
}

// Each joint a colour of its own, neighbours far apart on the colour circle.
Eigen::Array3d jointColor(int joint) {
  const double hue = std::fmod(joint * 0.381966, 1.0) * 6;
  const auto channel = [&](double shift) {
    const double h = std::fmod(hue + shift, 6.0);
    return 255 * (0.25 + 0.7 * std::clamp(std::abs(h - 3) - 1, 0.0, 1.0));
  };
  return {channel(0), channel(4), channel(2)};
}

// The mesh in the colours that `color_of` gives its vertices.
template <class ColorOf>
TriangleMesh painted(TriangleMesh mesh, const ColorOf& color_of) {
  if (mesh.uv.rows() == 0) return mesh;
  mesh.texture = blankImage(512, 512, kGrey);
  mesh.back_uv.resize(0, 2);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Points corners;
    Eigen::Array3d color = Eigen::Array3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, k);
      corners.push_back(mesh.uv.row(v).transpose().cast<double>() * 512 - Vector2d(0.5, 0.5));
      color += color_of(v) / 3;
    }
    const auto byte = [&](int c) { return static_cast<std::uint8_t>(std::lround(color(c))); };
    const Color flat{byte(0), byte(1), byte(2)};
    fillPolygons(mesh.texture, {corners}, flat);
    drawPolyline(mesh.texture, corners, 1, flat, true);
  }
  return mesh;
}

// In the colours of the joints that carry the skin.
TriangleMesh weightsPainted(const RiggedCharacter& character) {
  return painted(character.mesh, [&](int v) {
    Eigen::Array3d color = Eigen::Array3d::Zero();
    for (int k = 0; k < 4; ++k)
      color += character.weights.weights(v, k) * jointColor(character.weights.joints(v, k));
    return color;
  });
}

// Orange what moves with the joints nearest to the viewer, blue what moves with the farthest.
TriangleMesh depthPainted(const RiggedCharacter& character) {
  const auto depth = character.mesh.vertices.col(2);
  const double low = depth.minCoeff(), span = std::max(1e-6, depth.maxCoeff() - low);
  const auto array = [](const Color& c) { return Eigen::Array3d(c.r, c.g, c.b); };
  return painted(character.mesh, [&](int v) -> Eigen::Array3d {
    double z = 0;
    for (int k = 0; k < 4; ++k) {
      const auto joint = static_cast<size_t>(character.weights.joints(v, k));
      z += character.weights.weights(v, k) * character.skeleton.joints[joint].position.z();
    }
    const double near = std::clamp((z - low) / span, 0.0, 1.0);
    return near * array(kRight) + (1 - near) * array(kLeft);
  });
}

Image views(const TriangleMesh& mesh) {
  std::vector<Panel> panels;
  for (const auto& [label, yaw] :
       {std::pair{"front", 0.0}, {"three-quarter", 0.7}, {"side", 1.5708}, {"back", 3.1416}}) {
    const RenderOptions render{.width = kViewSize, .height = kViewSize};
    panels.push_back(
        {renderMesh(mesh.vertices, mesh, framingCamera(mesh.vertices, yaw, 0.1), render), label});
  }
  return montage(panels);
}

// The character at that share of the clip's duration.
Image posed(const RiggedDrawing& drawing, const Clip& clip, double share, int size) {
  const RiggedCharacter& character = drawing.character;
  const Pose pose = samplePose(clip, character.skeleton, static_cast<float>(share) * clip.duration_s());
  const auto heights = character.mesh.vertices.col(1);
  const auto posed_from_rest =
      posedFromRest(character.skeleton, pose, heights.maxCoeff() - heights.minCoeff());
  const auto vertices = skinVertices(character.mesh.vertices, character.weights, posed_from_rest);
  return renderMesh(vertices, character.mesh, framingCamera(vertices, 0.4, 0.1),
                    {.width = size, .height = size});
}

// One moment of each clip; of a single one, four.
Image clipsPicture(const RiggedDrawing& drawing) {
  std::vector<double> shares = {0.45};
  if (drawing.clips.size() == 1) shares = {0.2, 0.4, 0.6, 0.8};
  std::vector<Panel> panels;
  for (const Clip& clip : drawing.clips)
    for (const double share : shares) {
      char label[64];
      std::snprintf(label, sizeof label, "%s, %.1f s", clip.name.c_str(),
                    share * static_cast<double>(clip.duration_s()));
      panels.push_back({posed(drawing, clip, share, kViewSize), label});
    }
  return panels.empty() ? views(drawing.character.mesh) : montage(panels, {.columns = 4});
}

// The one of that name, or else the first.
const Clip& clipOr(const std::vector<Clip>& clips, std::string_view name) {
  const auto found =
      std::find_if(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
  return found == clips.end() ? clips.front() : *found;
}

// The model from the front, the side and behind, and waving, in one row.
Image sides(const RiggedDrawing& drawing) {
  const TriangleMesh& mesh = drawing.character.mesh;
  constexpr int kSize = 240;
  std::vector<Panel> panels;
  for (const double yaw : {0.0, 1.5708, 3.1416})
    panels.push_back({renderMesh(mesh.vertices, mesh, framingCamera(mesh.vertices, yaw, 0.05),
                                 {.width = kSize, .height = kSize}),
                      ""});
  if (!drawing.clips.empty())
    panels.push_back({posed(drawing, clipOr(drawing.clips, "wave"), 0.45, kSize), ""});
  return montage(panels, {.gap_px = 4});
}

// The figure alone, without the light of its page.
Image evenlyLit(const RiggedDrawing& drawing) {
  Image picture = drawing.even_light;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (drawing.silhouette.mask(y, x) == 0) std::fill_n(picture.pixel(x, y), 3, std::uint8_t{255});
  return fitted(picture, kPictureSize, kPictureSize);
}

// From the drawing to the model that moves, in one row: two moments of the walk tell it at a glance.
Image summary(const RiggedDrawing& drawing, const Image& skeleton) {
  std::vector<Panel> panels = {{fitted(onPaper(drawing.image), 420, 420), "the drawing"},
                               {fitted(skeleton, 420, 420), "its skeleton"}};
  if (drawing.clips.empty()) return montage(panels);
  for (const double share : {0.1, 0.6})
    panels.push_back({posed(drawing, clipOr(drawing.clips, "walk"), share, 420), "the model, moving"});
  return montage(panels);
}

}  // namespace

void writeTrace(const RiggedDrawing& drawing, const SilhouetteSteps& steps, const std::string& dir) {
  SKEL_CHECK(drawing.found());
  std::set<std::string> written;
  const auto write = [&](const char* name, const Image& picture) {
    writeFile(dir + "/" + name, encodePng(picture));
    written.insert(name);
  };
  write("1-drawing.png", onPaper(drawing.image));
  if (!steps.sheet.empty()) write("2-sheet.png", steps.sheet);
  if (!steps.unruled.empty()) write("2-unruled.png", steps.unruled);
  if (!drawing.even_light.empty()) write("2-even-light.png", evenlyLit(drawing));
  if (steps.figure_share.size() > 0) write("2-page-net.png", sharePicture(steps.figure_share));
  write("2-silhouette.png", silhouettePicture(drawing));
  if (drawing.silhouette.bridges.size() > 0) write("2-pieces.png", piecesPicture(drawing));
  Image distance = gridPicture(drawing);
  blit(distance, magnified(heatMap(drawing.candidates.distance), kMagnification), 0, 0);
  write("3-distance.png", distance);
  write("4-candidates.png", candidatesPicture(drawing));
  Image skeleton = onPaper(drawing.image, std::max(drawing.image.width, drawing.image.height));
  drawSkeleton(skeleton, drawing.recognition.skeleton);
  write("5-skeleton.png", fitted(skeleton, kPictureSize, kPictureSize));
  if (drawing.layers.part.size() != 0)
    write("6-layers.png", onPaper(layerPicture(drawing.layers, drawing.silhouette.mask)));
  write("6-mesh.png", views(drawing.character.mesh));
  write("7-depth.png", views(depthPainted(drawing.character)));
  write("7-skin.png", views(weightsPainted(drawing.character)));
  write("8-posed.png", clipsPicture(drawing));
  write("sides.png", sides(drawing));
  write("summary.png", summary(drawing, skeleton));
  // Of a run before, which needed steps that this one does not.
  for (const char* step :
       {"2-sheet.png", "2-unruled.png", "2-even-light.png", "2-page-net.png", "2-pieces.png", "6-layers.png"})
    if (const std::string path = dir + "/" + step; !written.contains(step) && std::filesystem::exists(path)) {
      noteOutput(path);
      std::filesystem::remove(path);
    }
}

}  // namespace skel
