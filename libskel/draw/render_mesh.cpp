#include "libskel/draw/render_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/paper.h"
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

}  // namespace

Matrix3d eyeFromModel(const Camera& camera) {
  return (Eigen::AngleAxisd(camera.pitch_rad, Vector3d::UnitX()) *
          Eigen::AngleAxisd(-camera.yaw_rad, Vector3d::UnitY()))
      .toRotationMatrix();
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
  const Matrix3d eye = eyeFromModel(camera);

  // x, y in sample px; z = 1 / distance from the eye, which is linear on the screen.
  std::vector<Vector3f> screen;
  screen.reserve(std::size_t(vertices.rows()));
  const double scale = height / camera.view_height_m * camera.distance_m;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const Vector3d p = eye * (vertices.row(i).transpose().cast<double>() - camera.target);
    const double depth = camera.distance_m - p.z();
    screen.emplace_back(width / 2.0 - 0.5 + scale * p.x() / depth, height / 2.0 - 0.5 - scale * p.y() / depth,
                        1 / depth);
  }
  const Eigen::MatrixX3f normals = vertexNormals(vertices, mesh.triangles) * eye.transpose().cast<float>();
  const bool textured = !mesh.texture.empty() && mesh.uv.rows() == vertices.rows() && vertices.rows() > 0;
  const Image texture = textured ? textureAsSeen(mesh, screen) : Image();
  const bool repeat = textured && (mesh.uv.minCoeff() < 0 || mesh.uv.maxCoeff() > 1);
  const RowVector3f light = RowVector3f(-0.35f, 0.55f, 0.76f).normalized();

  Image samples = blankImage(width, height, kClear);
  std::vector<float> nearest(std::size_t(width) * height, 0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const RowVector3i v = mesh.triangles.row(t);
    const Vector3f &a = screen[v[0]], &b = screen[v[1]], &c = screen[v[2]];
    if (a.z() <= 0 || b.z() <= 0 || c.z() <= 0) continue;  // behind the eye
    const float area = cross2(a, b, c);
    if (area == 0) continue;
    RowVector2f uv[3];
    for (int k = 0; k < 3 && textured; ++k) uv[k] = mesh.uvOf(t, k);
    const int x0 = std::max(0, int(std::ceil(std::min({a.x(), b.x(), c.x()}))));
    const int x1 = std::min(width - 1, int(std::floor(std::max({a.x(), b.x(), c.x()}))));
    const int y0 = std::max(0, int(std::ceil(std::min({a.y(), b.y(), c.y()}))));
    const int y1 = std::min(height - 1, int(std::floor(std::max({a.y(), b.y(), c.y()}))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2f p{float(x), float(y)};
        const float wa = cross2(p, Eigen::Vector2f(b.head<2>()), Eigen::Vector2f(c.head<2>())) / area;
        const float wb = cross2(p, Eigen::Vector2f(c.head<2>()), Eigen::Vector2f(a.head<2>())) / area;
        const float wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const float z = wa * a.z() + wb * b.z() + wc * c.z();
        float& front = nearest[std::size_t(y) * width + x];
        if (z <= front) continue;
        front = z;
        const float pa = wa * a.z() / z, pb = wb * b.z() / z, pc = wc * c.z() / z;
        RowVector3f color = options.plain_rgb.transpose();
        if (textured) color = texel(texture, pa * uv[0] + pb * uv[1] + pc * uv[2], repeat);
        const RowVector3f normal =
            (pa * normals.row(v[0]) + pb * normals.row(v[1]) + pc * normals.row(v[2])).normalized();
        // Full light on what faces it within 45°, so that most of the front shows the drawing's own colours.
        const float lit = std::clamp(normal.dot(light) + 0.3f, 0.0f, 1.0f);
        color *= shadeOf(1 - options.shading * (1 - lit), color.minCoeff());
        std::uint8_t* pixel = samples.pixel(x, y);
        for (int k = 0; k < 3; ++k) pixel[k] = std::uint8_t(std::lround(color[k]));
        pixel[3] = 255;
      }
  }
  return resized(samples, options.width, options.height);
}

}  // namespace skel
