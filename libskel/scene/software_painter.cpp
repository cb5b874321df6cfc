// A rasteriser with four samples a pixel for the edges and one for the colour.
//
// J. Pineda, "A parallel algorithm for polygon rasterization" (1988): edge functions. K. Akeley,
// "RealityEngine graphics" (1993): several samples of coverage and depth that share one colour. L. Williams,
// "Pyramidal parametrics" (1983): textures at halved sizes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"
#include "libskel/mesh/vertex_normals.h"
#include "libskel/scene/mesh_painter.h"
#include "libskel/scene/shading.h"

namespace skel {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kSamples = 4;
// A rotated grid: no two samples of a pixel share a row or a column.
constexpr std::array<std::array<float, 2>, kSamples> kSamplePlaces = {
    {{-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}}};

using Pixel = std::array<std::uint8_t, 4>;

// What a thread paints into; kept from frame to frame.
struct Samples {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // the part of the picture
  std::vector<float> nearest;                 // 1 / distance
  std::vector<Pixel> colors;                  // straight alpha

  void clear(int left, int top, int right, int bottom) {
    x0 = left, y0 = top, width = right - left, height = bottom - top;
    const std::size_t count = std::size_t(width) * std::size_t(height) * kSamples;
    nearest.assign(count, 0);
    colors.assign(count, Pixel{});
  }
  std::size_t at(int x, int y) const {
    return (std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0)) * kSamples;
  }
};

struct Corner {
  Vector2f at;         // px
  float near = 0;      // 1 / distance, linear on the screen
  float u = 0, v = 0;  // texels of the level in use
  float lit = 1;
  Vector3f rgb;
};

std::uint8_t byte(float value) { return std::uint8_t(std::clamp(value, 0.f, 255.f) + 0.5f); }

// Bilinear; x and y in texels, whole numbers at their centres.
Vector3f texel(const Image& texture, float x, float y) {
  x = std::clamp(x, 0.f, float(texture.width - 1));
  y = std::clamp(y, 0.f, float(texture.height - 1));
  const int x0 = int(x), y0 = int(y);
  const int right = x0 + 1 < texture.width ? 4 : 0, below = y0 + 1 < texture.height ? 4 * texture.width : 0;
  const float fx = x - float(x0), fy = y - float(y0);
  const std::uint8_t* p = texture.pixel(x0, y0);
  const float a = (1 - fx) * (1 - fy), b = fx * (1 - fy), c = (1 - fx) * fy, d = fx * fy;
  Vector3f color;
  for (int k = 0; k < 3; ++k)
    color[k] =
        a * float(p[k]) + b * float(p[k + right]) + c * float(p[k + below]) + d * float(p[k + right + below]);
  return color;
}

class SoftwarePainter : public MeshPainter {
 public:
  explicit SoftwarePainter(const TriangleMesh& mesh)
      : triangles_(mesh.triangles), vertex_count_(mesh.vertices.rows()) {
    if (mesh.texture.empty() || mesh.uv.rows() != mesh.vertices.rows() || mesh.uv.rows() == 0) return;
    uv_ = mesh.uv;
    repeat_ = uv_.minCoeff() < 0 || uv_.maxCoeff() > 1;
    levels_.push_back(mesh.texture);
    while (levels_.back().width > 16 && levels_.back().height > 16)
      levels_.push_back(resized(levels_.back(), levels_.back().width / 2, levels_.back().height / 2));
  }

  bool isConcurrent() const override { return true; }

  Image paint(const Eigen::MatrixX3f& vertices, const Camera& camera, int width, int height,
              const Surface& surface) override {
    SKEL_CHECK_EQ(vertices.rows(), vertex_count_);
    SKEL_CHECK(width >= 1 && height >= 1);
    Image image = blankImage(width, height, kClear);
    if (vertices.rows() == 0 || (!surface.fill && !surface.wires)) return image;

    std::vector<Corner> corners = project(vertices, camera, width, height);
    const Image* texture = surface.colors || uv_.rows() == 0 ? nullptr : &levelFor(corners);
    colour(corners, vertices, camera, surface, texture);

    Vector2f low(1e9f, 1e9f), high(-1e9f, -1e9f);
    for (const Corner& corner : corners)
      if (corner.near > 0) low = low.cwiseMin(corner.at), high = high.cwiseMax(corner.at);
    const int left = std::clamp(int(std::floor(low.x())) - 1, 0, width),
              top = std::clamp(int(std::floor(low.y())) - 1, 0, height);
    const int right = std::clamp(int(std::ceil(high.x())) + 2, left, width),
              bottom = std::clamp(int(std::ceil(high.y())) + 2, top, height);
    if (left == right || top == bottom) return image;

    thread_local Samples samples;
    samples.clear(left, top, right, bottom);
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t)
      drawTriangle(samples, corners[std::size_t(triangles_(t, 0))], corners[std::size_t(triangles_(t, 1))],
                   corners[std::size_t(triangles_(t, 2))], surface, texture);
    resolve(samples, image);
    return image;
  }

 private:
  static std::vector<Corner> project(const Eigen::MatrixX3f& vertices, const Camera& camera, int width,
                                     int height) {
    const Eigen::Matrix3f eye = eyeFromModel(camera).cast<float>();
    const Vector3f target = camera.target.cast<float>();
    const float distance = float(camera.distance_m),
                scale = float(height / camera.view_height_m * camera.distance_m);
    std::vector<Corner> corners(std::size_t(vertices.rows()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3f p = eye * (vertices.row(Eigen::Index(i)).transpose() - target);
      const float depth = distance - p.z();
      if (depth <= 0) continue;  // behind the eye: near stays 0
      corners[i].near = 1 / depth;
      corners[i].at = {float(width) / 2 - 0.5f + scale * p.x() / depth,
                       float(height) / 2 - 0.5f - scale * p.y() / depth};
    }
    return corners;
  }

  // The one whose texels are about as large as pixels.
  const Image& levelFor(const std::vector<Corner>& corners) const {
    double seen = 0, held = 0;
    const auto cross = [](const Vector2f& a, const Vector2f& b) {
      return std::abs(a.x() * b.y() - a.y() * b.x());
    };
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
      const Eigen::RowVector3i v = triangles_.row(t);
      const Corner &a = corners[std::size_t(v[0])], &b = corners[std::size_t(v[1])],
                   &c = corners[std::size_t(v[2])];
      if (a.near <= 0 || b.near <= 0 || c.near <= 0) continue;
      seen += double(cross(b.at - a.at, c.at - a.at));
      held += double(
          cross((uv_.row(v[1]) - uv_.row(v[0])).transpose(), (uv_.row(v[2]) - uv_.row(v[0])).transpose()));
    }
    held *= double(levels_[0].width) * levels_[0].height;
    // Rather too sharp than too soft: drawn lines are thin.
    const double halvings = seen > 0 && held > 0 ? 0.5 * std::log2(held / seen) + 0.3 : 0;
    return levels_[std::size_t(std::clamp(halvings, 0.0, double(levels_.size() - 1)))];
  }

  void colour(std::vector<Corner>& corners, const Eigen::MatrixX3f& vertices, const Camera& camera,
              const Surface& surface, const Image* texture) const {
    const Eigen::MatrixX3f normals = vertexNormals(vertices, triangles_);
    const Vector3f light = eyeFromModel(camera).cast<float>().transpose() * lightDirection();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto row = Eigen::Index(i);
      Corner& corner = corners[i];
      const float lit = std::clamp(normals.row(row).dot(light) + kLightReach, 0.f, 1.f);
      corner.lit = 1 - surface.shading * (1 - lit);
      if (texture) {
        corner.u = uv_(row, 0) * float(texture->width);
        corner.v = uv_(row, 1) * float(texture->height);
      } else {
        corner.rgb = surface.colors ? Vector3f(surface.colors->row(row)) : surface.plain_rgb;
      }
    }
  }

  void drawTriangle(Samples& samples, const Corner& first, const Corner& second, const Corner& third,
                    const Surface& surface, const Image* texture) const {
    if (first.near <= 0 || second.near <= 0 || third.near <= 0) return;
    const std::array<const Corner*, 3> c = {&first, &second, &third};
    const Vector2f origin = first.at;  // keeps the numbers small
    std::array<Vector2f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = c[k]->at - origin;
    float area = p[1].x() * p[2].y() - p[1].y() * p[2].x();
    if (area == 0 || !std::isfinite(area)) return;
    const float sign = area > 0 ? 1.f : -1.f;
    area *= sign;

    // Edge functions, 0 on the edge across from corner k and `area` at the corner: share k times the area.
    std::array<float, 3> ax, ay, constant, reach, per_px;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2f &from = p[(k + 1) % 3], &to = p[(k + 2) % 3];
      ax[k] = -sign * (to.y() - from.y());
      ay[k] = sign * (to.x() - from.x());
      constant[k] = -(ax[k] * from.x() + ay[k] * from.y());
      reach[k] = 0.375f * (std::abs(ax[k]) + std::abs(ay[k]));
      per_px[k] = 1 / std::max(std::hypot(ax[k], ay[k]), 1e-12f);
    }
    const auto low = [&](int axis) { return std::min({c[0]->at[axis], c[1]->at[axis], c[2]->at[axis]}); };
    const auto high = [&](int axis) { return std::max({c[0]->at[axis], c[1]->at[axis], c[2]->at[axis]}); };
    const int x0 = std::max(samples.x0, int(std::ceil(low(0) - 0.375f))),
              x1 = std::min(samples.x0 + samples.width - 1, int(std::floor(high(0) + 0.375f)));
    const int y0 = std::max(samples.y0, int(std::ceil(low(1) - 0.375f))),
              y1 = std::min(samples.y0 + samples.height - 1, int(std::floor(high(1) + 0.375f)));

    const float inv_area = 1 / area;
    const std::array<float, 3> near = {c[0]->near * inv_area, c[1]->near * inv_area, c[2]->near * inv_area};
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const float px = float(x) - origin.x(), py = float(y) - origin.y();
        std::array<float, 3> edge;
        bool outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
          edge[k] = ax[k] * px + ay[k] * py + constant[k];
          outside |= edge[k] < -reach[k];
        }
        if (outside) continue;
        const std::size_t at = samples.at(x, y);
        unsigned seen = 0, on_wire = 0;
        float sx = 0, sy = 0;
        int count = 0;
        for (unsigned s = 0; s < kSamples; ++s) {
          const float ox = kSamplePlaces[s][0], oy = kSamplePlaces[s][1];
          const float e0 = edge[0] + ax[0] * ox + ay[0] * oy, e1 = edge[1] + ax[1] * ox + ay[1] * oy,
                      e2 = edge[2] + ax[2] * ox + ay[2] * oy;
          if (e0 < 0 || e1 < 0 || e2 < 0) continue;
          if (surface.wires) {
            const bool wire =
                std::min({e0 * per_px[0], e1 * per_px[1], e2 * per_px[2]}) < surface.wire_px / 2;
            if (wire) on_wire |= 1u << s;
            if (!wire && !surface.fill) continue;
          }
          const float z = e0 * near[0] + e1 * near[1] + e2 * near[2];
          if (z <= samples.nearest[at + s]) continue;
          samples.nearest[at + s] = z;
          seen |= 1u << s;
          sx += ox, sy += oy, ++count;
        }
        if (count == 0) continue;
        // The colour of the middle of the samples that are seen, which lies in the triangle.
        if (count < kSamples)
          for (std::size_t k = 0; k < 3; ++k) edge[k] += (ax[k] * sx + ay[k] * sy) / float(count);
        std::array<float, 3> share;
        for (std::size_t k = 0; k < 3; ++k) share[k] = std::max(0.f, edge[k]) * near[k];
        const float all = 1 / (share[0] + share[1] + share[2]);
        for (float& one : share) one *= all;
        const Vector3f rgb = colorAt(c, share, texture);
        const Pixel fill = {byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), byte(255 * surface.opacity)};
        const Pixel wire = on_wire ? wireColor(fill, surface) : fill;
        for (unsigned s = 0; s < kSamples; ++s)
          if (seen >> s & 1) samples.colors[at + s] = on_wire >> s & 1 ? wire : fill;
      }
  }

  Vector3f colorAt(const std::array<const Corner*, 3>& c, const std::array<float, 3>& share,
                   const Image* texture) const {
    const float lit = share[0] * c[0]->lit + share[1] * c[1]->lit + share[2] * c[2]->lit;
    if (!texture) return lit * (share[0] * c[0]->rgb + share[1] * c[1]->rgb + share[2] * c[2]->rgb);
    float u = share[0] * c[0]->u + share[1] * c[1]->u + share[2] * c[2]->u;
    float v = share[0] * c[0]->v + share[1] * c[1]->v + share[2] * c[2]->v;
    if (repeat_) {
      u -= std::floor(u / float(texture->width)) * float(texture->width);
      v -= std::floor(v / float(texture->height)) * float(texture->height);
    }
    return lit * texel(*texture, u - 0.5f, v - 0.5f);
  }

  // Over the fill, if there is one.
  static Pixel wireColor(const Pixel& fill, const Surface& surface) {
    const Color& ink = surface.wire_color;
    if (!surface.fill) return {ink.r, ink.g, ink.b, ink.a};
    const float over = float(ink.a) / 255, alpha = over + surface.opacity * (1 - over);
    const float share = alpha > 0 ? over / alpha : 1;
    const auto mix = [&](std::uint8_t wire, std::uint8_t under) {
      return byte(share * float(wire) + (1 - share) * float(under));
    };
    return {mix(ink.r, fill[0]), mix(ink.g, fill[1]), mix(ink.b, fill[2]), byte(255 * alpha)};
  }

  static void resolve(const Samples& samples, Image& image) {
    for (int y = samples.y0; y < samples.y0 + samples.height; ++y)
      for (int x = samples.x0; x < samples.x0 + samples.width; ++x) {
        const Pixel* s = &samples.colors[samples.at(x, y)];
        int alpha = 0, rgb[3] = {};
        for (int i = 0; i < kSamples; ++i) {
          alpha += s[i][3];
          for (std::size_t k = 0; k < 3; ++k) rgb[k] += s[i][k] * s[i][3];
        }
        if (alpha == 0) continue;
        std::uint8_t* p = image.pixel(x, y);
        for (int k = 0; k < 3; ++k) p[k] = std::uint8_t((rgb[k] + alpha / 2) / alpha);
        p[3] = std::uint8_t((alpha + kSamples / 2) / kSamples);
      }
  }

  Eigen::MatrixX3i triangles_;
  Eigen::Index vertex_count_;
  Eigen::MatrixX2f uv_;
  bool repeat_ = false;
  std::vector<Image> levels_;  // the texture, each half as large as the one before
};

}  // namespace

std::unique_ptr<MeshPainter> softwarePainter(const TriangleMesh& mesh) {
  return std::make_unique<SoftwarePainter>(mesh);
}

}  // namespace skel
