#include "libskel/draw/render_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/paper.h"
#include "libskel/mesh/ink_hull.h"
#include "libskel/mesh/vertex_normals.h"

namespace skel {

namespace {

using Eigen::Matrix3d;
using Eigen::RowVector2f;
using Eigen::RowVector3f;
using Eigen::RowVector3i;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Bilinear, 0…255.
RowVector3f texel(const Image& texture, const RowVector2f& uv, bool repeat) {
  const float u = repeat ? uv.x() - std::floor(uv.x()) : uv.x();
  const float v = repeat ? uv.y() - std::floor(uv.y()) : uv.y();
  const float x = std::clamp(u * float(texture.width) - 0.5f, 0.0f, float(texture.width - 1));
  const float y = std::clamp(v * float(texture.height) - 0.5f, 0.0f, float(texture.height - 1));
  const int x0 = int(x), y0 = int(y);
  const int x1 = std::min(x0 + 1, texture.width - 1), y1 = std::min(y0 + 1, texture.height - 1);
  const auto at = [&](int i, int j) {
    const std::uint8_t* p = texture.pixel(i, j);
    return RowVector3f(p[0], p[1], p[2]);
  };
  const float fx = x - float(x0), fy = y - float(y0);
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x1, y0)) +
         fy * ((1 - fx) * at(x0, y1) + fx * at(x1, y1));
}

// Twice the signed area.
template <class P>
float cross2(const P& a, const P& b, const P& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The texture at about the resolution at which it is seen, so that a small picture of a large drawing keeps
// its lines.
Image textureAsSeen(const TriangleMesh& mesh, const std::vector<Vector3f>& screen) {
  double seen = 0, held = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const RowVector3i v = mesh.triangles.row(t);
    const RowVector2f a = mesh.uvOf(t, 0), b = mesh.uvOf(t, 1), c = mesh.uvOf(t, 2);
    seen += std::abs(cross2(screen[v[0]], screen[v[1]], screen[v[2]]));
    held += std::abs(cross2(a, b, c));
  }
  held *= double(mesh.texture.width) * mesh.texture.height;
  const double shrink = held > 0 ? std::sqrt(seen / held) : 1;
  if (shrink > 0.7) return mesh.texture;
  return resized(mesh.texture, std::max(1, int(mesh.texture.width * shrink)),
                 std::max(1, int(mesh.texture.height * shrink)));
}

// x, y in px; z = 1 / distance from the eye, which is linear on the screen.
std::vector<Vector3f> onScreen(const Eigen::MatrixX3f& vertices, const Camera& camera, int width,
                               int height) {
  const Matrix3d eye = eyeFromModel(camera);
  const double scale = height / camera.view_height_m * camera.distance_m;
  std::vector<Vector3f> screen;
  screen.reserve(std::size_t(vertices.rows()));
  for (const auto& vertex : vertices.rowwise()) {
    const Vector3d p = eye * (vertex.transpose().cast<double>() - camera.target);
    const double depth = camera.distance_m - p.z();
    screen.emplace_back(width / 2.0 - 0.5 + scale * p.x() / depth, height / 2.0 - 0.5 - scale * p.y() / depth,
                        1 / depth);
  }
  return screen;
}

// A picture of which each pixel shows what is nearest.
struct Samples {
  Image image;
  std::vector<float> nearest;  // 1 / distance

  Samples(int width, int height)
      : image(blankImage(width, height, kClear)), nearest(std::size_t(width) * height, 0) {}

  // `color`: 0…255, by the shares of the corners.
  template <class ColorAt>
  void draw(const Vector3f& a, const Vector3f& b, const Vector3f& c, const ColorAt& color_at) {
    if (a.z() <= 0 || b.z() <= 0 || c.z() <= 0) return;  // behind the eye
    const float area = cross2(a, b, c);
    if (area == 0) return;
    const int x0 = std::max(0, int(std::ceil(std::min({a.x(), b.x(), c.x()}))));
    const int x1 = std::min(image.width - 1, int(std::floor(std::max({a.x(), b.x(), c.x()}))));
    const int y0 = std::max(0, int(std::ceil(std::min({a.y(), b.y(), c.y()}))));
    const int y1 = std::min(image.height - 1, int(std::floor(std::max({a.y(), b.y(), c.y()}))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2f p{float(x), float(y)};
        const float wa = cross2(p, Eigen::Vector2f(b.head<2>()), Eigen::Vector2f(c.head<2>())) / area;
        const float wb = cross2(p, Eigen::Vector2f(c.head<2>()), Eigen::Vector2f(a.head<2>())) / area;
        const float wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const float z = wa * a.z() + wb * b.z() + wc * c.z();
        float& front = nearest[std::size_t(y) * image.width + x];
        if (z <= front) continue;
        front = z;
        const RowVector3f color = color_at(wa * a.z() / z, wb * b.z() / z, wc * c.z() / z);
        std::uint8_t* pixel = image.pixel(x, y);
        for (int k = 0; k < 3; ++k) pixel[k] = std::uint8_t(std::lround(color[k]));
        pixel[3] = 255;
      }
  }
};

}  // namespace

Matrix3d eyeFromModel(const Camera& camera) {
  return (Eigen::AngleAxisd(camera.pitch_rad, Vector3d::UnitX()) *
          Eigen::AngleAxisd(-camera.yaw_rad, Vector3d::UnitY()))
      .toRotationMatrix();
}

Vector3d eyeOf(const Camera& camera) {
  return camera.target + camera.distance_m * eyeFromModel(camera).transpose() * Vector3d::UnitZ();
}

Camera framingCamera(const Eigen::MatrixX3f& vertices, double yaw_rad, double pitch_rad,
                     double width_over_height) {
  SKEL_CHECK(vertices.rows() > 0);
  Camera camera;
  camera.yaw_rad = yaw_rad;
  camera.pitch_rad = pitch_rad;
  const Matrix3d eye = eyeFromModel(camera);
  Vector3d low = Vector3d::Constant(1e18), high = -low;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Vector3d p = eye * vertices.row(i).transpose().cast<double>();
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const Vector3d middle = (low + high) / 2;
  camera.target = eye.transpose() * middle;
  camera.distance_m = 4 * std::max((high - low).maxCoeff(), 1e-6);
  double half = 1e-6;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Vector3d p = eye * vertices.row(i).transpose().cast<double>() - middle;
    half = std::max(half, std::max(std::abs(p.y()), std::abs(p.x()) / width_over_height) * camera.distance_m /
                              (camera.distance_m - p.z()));
  }
  constexpr double kMargin = 1.06;
  camera.view_height_m = 2 * kMargin * half;
  return camera;
}

Projection::Projection(const Camera& camera, int width, int height)
    : eye_(eyeFromModel(camera)),
      camera_(camera),
      scale_(height / camera.view_height_m * camera.distance_m),
      middle_(width / 2.0 - 0.5, height / 2.0 - 0.5) {}

std::optional<Eigen::Vector2d> Projection::operator()(const Vector3d& model) const {
  const Vector3d p = eye_ * (model - camera_.target);
  const double depth = camera_.distance_m - p.z();
  if (depth <= 0) return std::nullopt;
  return middle_ + scale_ / depth * Eigen::Vector2d(p.x(), -p.y());
}

double Projection::pxPerMetre(const Vector3d& model) const {
  return scale_ / std::max(camera_.distance_m - (eye_ * (model - camera_.target)).z(), 1e-9);
}

Image renderMesh(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, const Camera& camera,
                 const RenderOptions& options) {
  SKEL_CHECK_EQ(vertices.rows(), mesh.vertices.rows());
  SKEL_CHECK(options.width >= 1 && options.height >= 1 && options.samples >= 1);
  const int width = options.width * options.samples, height = options.height * options.samples;
  const std::vector<Vector3f> screen = onScreen(vertices, camera, width, height);
  const Eigen::MatrixX3f in_model = vertexNormals(vertices, mesh.triangles),
                         normals = in_model * eyeFromModel(camera).transpose().cast<float>();
  const bool textured = !mesh.texture.empty() && mesh.uv.rows() == vertices.rows() && vertices.rows() > 0;
  const Image texture = textured ? textureAsSeen(mesh, screen) : Image();
  const bool repeat = textured && (mesh.uv.minCoeff() < 0 || mesh.uv.maxCoeff() > 1);
  const RowVector3f light = RowVector3f(-0.35f, 0.55f, 0.76f).normalized();

  Samples samples(width, height);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const RowVector3i v = mesh.triangles.row(t);
    RowVector2f uv[3];
    for (int k = 0; k < 3 && textured; ++k) uv[k] = mesh.uvOf(t, k);
    samples.draw(screen[v[0]], screen[v[1]], screen[v[2]], [&](float a, float b, float c) {
      RowVector3f color = options.plain_rgb.transpose();
      if (textured) color = texel(texture, a * uv[0] + b * uv[1] + c * uv[2], repeat);
      const RowVector3f normal =
          (a * normals.row(v[0]) + b * normals.row(v[1]) + c * normals.row(v[2])).normalized();
      // Full light on what faces it within 45°, so that most of the front shows the drawing's own colours.
      const float lit = std::clamp(normal.dot(light) + 0.3f, 0.0f, 1.0f);
      return RowVector3f(color * shadeOf(1 - options.shading * (1 - lit), color.minCoeff()));
    });
  }
  if (const Eigen::VectorXf reach_m = options.ink ? inkReach(mesh) : Eigen::VectorXf(); reach_m.size() > 0) {
    const InkHull ink = inkHull(vertices, mesh.triangles, in_model, reach_m, eyeOf(camera).cast<float>());
    const std::vector<Vector3f> hull = onScreen(ink.vertices, camera, width, height);
    for (const auto& t : ink.triangles.rowwise())
      samples.draw(hull[t[0]], hull[t[1]], hull[t[2]],
                   [&](float, float, float) { return RowVector3f(mesh.ink.rgb.transpose()); });
  }
  return resized(samples.image, options.width, options.height);
}

}  // namespace skel
