#include "libskel/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "libskel/draw/canvas.h"
#include "libskel/draw/draw_skeleton.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kTranslucency = 0.35f;

double meanEdge(const TriangleMesh& mesh) {
  if (mesh.triangles.rows() == 0) return 0;
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      sum += double((mesh.vertices.row(a) - mesh.vertices.row(b)).norm());
    }
  return sum / double(3 * mesh.triangles.rows());
}

// The finer the mesh is on the picture, the paler its wires, which would else hide what they cover.
Color wireColor(double edge_px, float wire_px, bool filled) {
  // Of a tiling by equilateral triangles.
  const double covered = std::min(1.0, 2 * std::sqrt(3.0) * double(wire_px) / std::max(edge_px, 1e-6));
  const double darkening = filled ? 0.09 : 0.3, most = filled ? 0.43 : 0.75;
  return kInk.withAlpha(std::uint8_t(std::lround(255 * std::min(most, darkening / covered))));
}

// A soft disc on the ground below the body; smaller and paler the higher the body is.
void drawShadow(Image& image, const Eigen::MatrixX3f& vertices, float ground_y, const Camera& camera) {
  if (vertices.rows() == 0) return;
  const float low = vertices.col(1).minCoeff(), high = vertices.col(1).maxCoeff();
  const double lift = std::clamp(double((low - ground_y) / std::max(high - low, 1e-6f)), 0.0, 1.0);
  // Arms that reach out throw no shadow of note.
  const auto middleOf = [&](int axis) {
    std::vector<float> values(vertices.col(axis).begin(), vertices.col(axis).end());
    const auto share = [&](double s) {
      const auto at = values.begin() + std::ptrdiff_t(s * double(values.size() - 1));
      std::nth_element(values.begin(), at, values.end());
      return double(*at);
    };
    return std::pair(share(0.08), share(0.92));
  };
  const auto [x0, x1] = middleOf(0);
  const auto [z0, z1] = middleOf(2);
  const double spread = 1 - 0.5 * lift, dark = 120 * (1 - 0.7 * lift);
  const double rx = std::max(0.66 * (x1 - x0) * spread, 1e-6);
  const double rz = std::max({0.8 * (z1 - z0) * spread, 0.45 * rx});
  const Vector3d center((x0 + x1) / 2, double(ground_y), (z0 + z1) / 2);

  // The box of the disc's corners on the screen, then for each pixel the point of the ground behind it.
  const Projection project(camera, image.width, image.height);
  Vector2d corner = Vector2d::Constant(1e9), opposite = -corner;
  for (const double sx : {-1.0, 1.0})
    for (const double sz : {-1.0, 1.0}) {
      const auto p = project(center + Vector3d(sx * rx, 0, sz * rz));
      if (!p) return;
      corner = corner.cwiseMin(*p), opposite = opposite.cwiseMax(*p);
    }
  const int left = std::max(0, int(std::floor(std::max(corner.x(), 0.0))));
  const int right = std::min(image.width - 1, int(std::ceil(std::min(opposite.x(), 1e6))));
  const int top = std::max(0, int(std::floor(std::max(corner.y(), 0.0))));
  const int bottom = std::min(image.height - 1, int(std::ceil(std::min(opposite.y(), 1e6))));
  const Eigen::Matrix3d model_from_eye = eyeFromModel(camera).transpose();
  const Vector3d eye = eyeOf(camera);
  const double px = image.height / camera.view_height_m * camera.distance_m;
  Image shade = blankImage(right - left + 1, std::max(0, bottom - top + 1), kClear);
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const Vector3d ray = model_from_eye * Vector3d((x - image.width / 2.0 + 0.5) / px,
                                                     (image.height / 2.0 - 0.5 - y) / px, -1);
      const double way = (center.y() - eye.y()) / ray.y();
      if (!(way > 0)) continue;
      const Vector3d p = eye + way * ray - center;
      const double r2 = p.x() * p.x() / (rx * rx) + p.z() * p.z() / (rz * rz);
      if (r2 >= 1) continue;
      std::uint8_t* pixel = shade.pixel(x - left, y - top);
      pixel[0] = 20, pixel[1] = 24, pixel[2] = 40, pixel[3] = std::uint8_t(dark * (1 - r2) * (1 - r2));
    }
  if (!shade.empty()) blit(image, shade, left, top);
}

// One picture over another of the same size, alpha kept. What blit() does, for every pixel of a film.
void putOver(Image& below, const Image& above) {
  const std::uint8_t* a = above.rgba.data();
  std::uint8_t* b = below.rgba.data();
  for (Eigen::Index i = 0; i < above.rgba.rows(); ++i, a += 4, b += 4) {
    if (a[3] == 0) continue;
    if (a[3] == 255 || b[3] == 0) {
      std::copy(a, a + 4, b);
      continue;
    }
    const int under = b[3] * (255 - a[3]), over = 255 * a[3], all = under + over;
    for (int k = 0; k < 3; ++k) b[k] = std::uint8_t((a[k] * over + b[k] * under + all / 2) / all);
    b[3] = std::uint8_t((all + 127) / 255);
  }
}

}  // namespace

Color weightColor(double weight) {
  // The colours of heat, but for the darkest, on which no shading would show; from grey into them.
  const Color none{196, 202, 214}, heat = heatColor(0.35 + 0.65 * std::clamp(weight, 0.0, 1.0));
  const double share = std::clamp(weight / 0.3, 0.0, 1.0);
  const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
    return std::uint8_t(std::lround((1 - share) * a + share * b));
  };
  return {mixed(none.r, heat.r), mixed(none.g, heat.g), mixed(none.b, heat.b)};
}

Image paintBackground(const Look& look, int width, int height) {
  Image image = blankImage(width, height, look.background);
  if (!look.picture.empty()) putOver(image, covering(look.picture, width, height));
  return image;
}

double boneWidth(int height_px) { return std::max(1.5, height_px / 180.0); }

Scene::Scene(const RiggedCharacter& character, std::unique_ptr<MeshPainter> painter)
    : character_(character), painter_(std::move(painter)) {
  if (character.mesh.vertices.rows() > 0) ground_y_ = character.mesh.vertices.col(1).minCoeff();
  edge_m_ = meanEdge(character.mesh);
}

Image Scene::paint(const JointTransforms& posed_from_rest, const Camera& camera, int width, int height,
                   const Look& look) const {
  const Skeleton& skeleton = character_.skeleton;
  const Eigen::MatrixX3f vertices =
      skinVertices(character_.mesh.vertices, character_.weights, posed_from_rest, look.blending);
  const Projection project(camera, width, height);
  Image image = paintBackground(look, width, height);
  if (look.shadow && (look.solid || look.translucent)) drawShadow(image, vertices, ground_y_, camera);

  Surface surface;
  surface.fill = look.solid || look.translucent;
  surface.opacity = look.translucent ? kTranslucency : 1;
  surface.wires = look.wireframe;
  surface.ink = look.ink;
  surface.wire_color = wireColor(edge_m_ * project.pxPerMetre(camera.target), surface.wire_px, surface.fill);
  Eigen::MatrixX3f colors;
  if (look.weights_of >= 0) {
    const SkinWeights& weights = character_.weights;
    colors.resize(vertices.rows(), 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
      double weight = 0;
      for (int k = 0; k < 4; ++k)
        if (weights.joints(v, k) == look.weights_of) weight += double(weights.weights(v, k));
      const Color color = weightColor(weight);
      colors.row(v) << color.r, color.g, color.b;
    }
    surface.colors = &colors;
    surface.shading = 0.3f;
  }
  if (surface.fill || surface.wires)
    putOver(image, painter_->paint(vertices, camera, width, height, surface));

  if (look.skeleton || look.chosen >= 0) {
    const std::vector<Eigen::Vector3f> joints = posedJoints(skeleton, posed_from_rest);
    Skeleton seen = skeleton;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      seen.joints[j].image = project(joints[j].cast<double>()).value_or(Vector2d(-1e4, -1e4));
      seen.joints[j].confidence = 1;
    }
    const double bone_px = boneWidth(height);
    if (look.skeleton) drawSkeleton(image, seen, {.bone_px = bone_px});
    if (look.chosen >= 0) {
      const Joint& joint = seen.joints[std::size_t(look.chosen)];
      drawDisc(image, joint.image, 3.2 * bone_px, kWhite);
      drawDisc(image, joint.image, 2.5 * bone_px, sideColor(joint.name));
    }
  }
  return image;
}

}  // namespace skel
