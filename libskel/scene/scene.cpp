#include "libskel/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/draw/canvas.h"
#include "libskel/draw/draw_skeleton.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kTranslucency = 0.35f;

// Rings of a soft disc on the ground below the body; smaller and paler the higher the body is.
void drawShadow(Image& image, const Eigen::MatrixX3f& vertices, float ground_y, const Projection& project) {
  if (vertices.rows() == 0) return;
  const Eigen::RowVector3f low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  const float height = std::max(high.y() - low.y(), 1e-6f);
  const float lift = std::clamp((low.y() - ground_y) / height, 0.f, 1.f);
  // Arms that reach out throw no shadow of note: the middle half of the body's mass says where it stands.
  std::vector<float> x(vertices.rows()), z(vertices.rows());
  for (Eigen::Index i = 0; i < vertices.rows(); ++i)
    x[std::size_t(i)] = vertices(i, 0), z[std::size_t(i)] = vertices(i, 2);
  const auto range = [](std::vector<float>& values) {
    const auto share = [&](double s) {
      const auto at = values.begin() + std::ptrdiff_t(s * double(values.size() - 1));
      std::nth_element(values.begin(), at, values.end());
      return double(*at);
    };
    return std::pair(share(0.08), share(0.92));
  };
  const auto [x0, x1] = range(x);
  const auto [z0, z1] = range(z);
  const double spread = 1 - 0.5 * double(lift);
  const double rx = 0.62 * (x1 - x0) * spread, rz = std::max(0.75 * (z1 - z0), 0.3 * (x1 - x0)) * spread;
  constexpr int kRings = 9, kCorners = 40;
  const auto alpha = std::uint8_t(std::lround(13 * (1 - 0.7 * double(lift))));
  for (int ring = 0; ring < kRings; ++ring) {
    const double size = 1 - double(ring) / kRings;
    Points outline;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * std::numbers::pi * k / kCorners;
      const auto p = project({(x0 + x1) / 2 + rx * size * std::cos(angle), double(ground_y),
                              (z0 + z1) / 2 + rz * size * std::sin(angle)});
      if (!p) return;
      outline.push_back(*p);
    }
    fillPolygons(image, {outline}, Color{20, 24, 40, alpha});
  }
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

Projection::Projection(const Camera& camera, int width, int height)
    : eye_(eyeFromModel(camera)),
      camera_(camera),
      scale_(height / camera.view_height_m * camera.distance_m),
      middle_(width / 2.0 - 0.5, height / 2.0 - 0.5) {}

std::optional<Vector2d> Projection::operator()(const Vector3d& model) const {
  const Vector3d p = eye_ * (model - camera_.target);
  const double depth = camera_.distance_m - p.z();
  if (depth <= 0) return std::nullopt;
  return middle_ + scale_ / depth * Vector2d(p.x(), -p.y());
}

double Projection::pxPerMetre(const Vector3d& model) const {
  return scale_ / std::max(camera_.distance_m - (eye_ * (model - camera_.target)).z(), 1e-9);
}

Color weightColor(double weight) {
  // The colours of heat, but for the darkest, on which no shading would show.
  return weight <= 0 ? Color{196, 202, 214} : heatColor(0.25 + 0.75 * weight);
}

Image covering(const Image& picture, int width, int height) {
  const double scale = std::max(double(width) / picture.width, double(height) / picture.height);
  const Image sized = resized(picture, std::max(width, int(std::lround(picture.width * scale))),
                              std::max(height, int(std::lround(picture.height * scale))));
  Image result = blankImage(width, height, kClear);
  blit(result, sized, (width - sized.width) / 2, (height - sized.height) / 2);
  return result;
}

Scene::Scene(const RiggedCharacter& character, std::unique_ptr<MeshPainter> painter)
    : character_(character), painter_(std::move(painter)) {
  if (character.mesh.vertices.rows() > 0) ground_y_ = character.mesh.vertices.col(1).minCoeff();
}

Image Scene::paint(const JointTransforms& posed_from_rest, const Camera& camera, int width, int height,
                   const Look& look) const {
  const Skeleton& skeleton = character_.skeleton;
  const Eigen::MatrixX3f vertices =
      skinVertices(character_.mesh.vertices, character_.weights, posed_from_rest);
  const Projection project(camera, width, height);
  Image image = blankImage(width, height, look.background);
  if (!look.picture.empty()) putOver(image, covering(look.picture, width, height));
  if (look.shadow && (look.solid || look.translucent)) drawShadow(image, vertices, ground_y_, project);

  Surface surface;
  surface.fill = look.solid || look.translucent;
  surface.opacity = look.translucent ? kTranslucency : 1;
  surface.wires = look.wireframe;
  surface.wire_color = surface.fill ? kInk.withAlpha(110) : kInk.withAlpha(190);
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
    const double bone_px = std::max(1.5, height / 180.0);
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
