// A rasteriser with four samples a pixel for the edges and one for the colour.
//
// J. Pineda, "A parallel algorithm for polygon rasterization" (1988): edge functions. K. Akeley,
// "RealityEngine graphics" (1993): several samples of coverage and depth that share one colour. L. Williams,
// "Pyramidal parametrics" (1983): textures at halved sizes.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/paper.h"
#include "libskel/mesh/ink_hull.h"
#include "libskel/mesh/split_seams.h"
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

// One value a sample.
using Lanes = float __attribute__((vector_size(4 * kSamples)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * kSamples)));
constexpr Lanes kSampleX = {kSamplePlaces[0][0], kSamplePlaces[1][0], kSamplePlaces[2][0],
                            kSamplePlaces[3][0]};
constexpr Lanes kSampleY = {kSamplePlaces[0][1], kSamplePlaces[1][1], kSamplePlaces[2][1],
                            kSamplePlaces[3][1]};
constexpr float kReach = 0.375f;  // of the samples from the pixel's centre, along each axis

// Bit i: lane i.
unsigned bits(const LaneMask& mask) {
#ifdef __SSE__
  return unsigned(__builtin_ia32_movmskps(Lanes(mask)));
#else
  return unsigned((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
constexpr unsigned kAll = (1u << kSamples) - 1;

using Pixel = std::uint32_t;  // r, g, b and straight alpha, from the lowest byte up

Pixel packed(unsigned r, unsigned g, unsigned b, unsigned a) { return r | g << 8 | b << 16 | a << 24; }
unsigned channel(Pixel pixel, int k) { return pixel >> (8 * k) & 255; }

// What a thread paints into; kept from frame to frame.
struct Samples {
  int x0 = 0, y0 = 0, width = 0, height = 0;        // the part of the picture
  std::vector<Lanes> nearest;                       // 1 / distance; 0: nothing there yet
  std::vector<std::array<Pixel, kSamples>> colors;  // where there is something

  void clear(int left, int top, int right, int bottom) {
    x0 = left, y0 = top, width = right - left, height = bottom - top;
    const std::size_t count = std::size_t(width) * std::size_t(height);
    nearest.assign(count, Lanes{});
    if (colors.size() < count) colors.resize(count);
  }
  std::size_t at(int x, int y) const {
    return std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0);
  }
};

struct Corner {
  Vector2f at;         // px
  float near = 0;      // 1 / distance, linear on the screen
  float u = 0, v = 0;  // texels of the level in use
  float lit = 1;
  Vector3f rgb;
};

unsigned byte(float value) { return unsigned(std::clamp(value, 0.f, 255.f) + 0.5f); }

// Bilinear, in steps of 1/256; x and y in texels, whole numbers at their centres; `lit` at most 1.
Pixel texel(const Image& texture, float x, float y, float lit, unsigned alpha) {
  x = std::clamp(x, 0.f, float(texture.width - 1));
  y = std::clamp(y, 0.f, float(texture.height - 1));
  const int x0 = int(x), y0 = int(y);
  const int right = x0 + 1 < texture.width ? 4 : 0, below = y0 + 1 < texture.height ? 4 * texture.width : 0;
  const auto fx = unsigned((x - float(x0)) * 256), fy = unsigned((y - float(y0)) * 256);
  const std::uint8_t *p = texture.pixel(x0, y0), *q = p + below;
  const unsigned a = (256 - fx) * (256 - fy), b = fx * (256 - fy), c = (256 - fx) * fy, d = fx * fy;
  const auto mixed = [&](int k) { return (a * p[k] + b * p[k + right] + c * q[k] + d * q[k + right]) >> 16; };
  const unsigned red = mixed(0), green = mixed(1), blue = mixed(2);
  const auto light = unsigned(shadeOf(lit, float(std::min({red, green, blue}))) * 256 + 0.5f);
  const auto shaded = [&](unsigned value) { return (value * light + 128) >> 8; };
  return packed(shaded(red), shaded(green), shaded(blue), alpha);
}

// Whether each part of the mesh is closed and its triangles look outwards: then those that look away are
// never seen.
bool isSolid(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * std::size_t(mesh.triangles.rows()));
  std::vector<int> part(std::size_t(mesh.vertices.rows()));
  std::iota(part.begin(), part.end(), 0);
  const auto partOf = [&](int v) {
    while (part[std::size_t(v)] != v) v = part[std::size_t(v)] = part[std::size_t(part[std::size_t(v)])];
    return v;
  };
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      edges.emplace_back(from, to);
      part[std::size_t(partOf(from))] = partOf(to);
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i] == edges[i - 1]) return false;
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(edges[i].second, edges[i].first)))
      return false;
  }
  std::vector<double> volume(part.size(), 0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t);
    const Vector3f a = mesh.vertices.row(v[0]), b = mesh.vertices.row(v[1]), c = mesh.vertices.row(v[2]);
    volume[std::size_t(partOf(v[0]))] += double(a.dot(b.cross(c)));
  }
  return std::all_of(volume.begin(), volume.end(), [](double one) { return one >= 0; });
}

class SoftwarePainter : public MeshPainter {
 public:
  explicit SoftwarePainter(const TriangleMesh& mesh)
      : triangles_(mesh.triangles),
        vertex_count_(mesh.vertices.rows()),
        solid_(isSolid(mesh)),
        ink_rgb_(mesh.ink.rgb),
        ink_reach_m_(inkReach(mesh)) {
    SplitMesh split = splitSeams(mesh);
    drawn_ = std::move(split.mesh.triangles);
    source_ = std::move(split.source);
    if (mesh.texture.empty() || mesh.uv.rows() != mesh.vertices.rows() || mesh.uv.rows() == 0) return;
    uv_ = std::move(split.mesh.uv);
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

    std::vector<Corner> corners = project(vertices(source_, Eigen::all), camera, width, height);
    const Image* texture = surface.colors || uv_.rows() == 0 ? nullptr : &levelFor(corners);
    const Eigen::MatrixX3f normals = vertexNormals(vertices, triangles_);
    colour(corners, normals, camera, surface, texture);

    InkHull ink;
    std::vector<Corner> hull;
    if (surface.hasInk() && ink_reach_m_.size() > 0) {
      ink = inkHull(vertices, triangles_, normals, ink_reach_m_, eyeOf(camera).cast<float>());
      hull = project(ink.vertices, camera, width, height);
      for (Corner& corner : hull) corner.rgb = ink_rgb_;
    }

    Vector2f low(1e9f, 1e9f), high(-1e9f, -1e9f);
    for (const std::vector<Corner>* all : {&corners, &hull})
      for (const Corner& corner : *all)
        if (corner.near > 0) low = low.cwiseMin(corner.at), high = high.cwiseMax(corner.at);
    const int left = std::clamp(int(std::floor(low.x())) - 1, 0, width),
              top = std::clamp(int(std::floor(low.y())) - 1, 0, height);
    const int right = std::clamp(int(std::ceil(high.x())) + 2, left, width),
              bottom = std::clamp(int(std::ceil(high.y())) + 2, top, height);
    if (left == right || top == bottom) return image;

    thread_local Samples samples;
    samples.clear(left, top, right, bottom);
    for (Eigen::Index t = 0; t < drawn_.rows(); ++t) {
      const Corner &a = corners[std::size_t(drawn_(t, 0))], &b = corners[std::size_t(drawn_(t, 1))],
                   &c = corners[std::size_t(drawn_(t, 2))];
      if (surface.wires)
        drawTriangle<true>(samples, a, b, c, surface, texture);
      else
        drawTriangle<false>(samples, a, b, c, surface, texture);
    }
    for (const auto& t : ink.triangles.rowwise())
      drawTriangle<false>(samples, hull[std::size_t(t[0])], hull[std::size_t(t[1])], hull[std::size_t(t[2])],
                          surface, nullptr);
    resolve(samples, image);
    return image;
  }

 private:
  static std::vector<Corner> project(const Eigen::MatrixX3f& places, const Camera& camera, int width,
                                     int height) {
    const Eigen::Matrix3f eye = eyeFromModel(camera).cast<float>();
    const Vector3f target = camera.target.cast<float>();
    const float distance = float(camera.distance_m),
                scale = float(height / camera.view_height_m * camera.distance_m);
    std::vector<Corner> corners(std::size_t(places.rows()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3f p = eye * (places.row(Eigen::Index(i)).transpose() - target);
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
    for (Eigen::Index t = 0; t < drawn_.rows(); ++t) {
      const Eigen::RowVector3i v = drawn_.row(t);
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

  void colour(std::vector<Corner>& corners, const Eigen::MatrixX3f& normals, const Camera& camera,
              const Surface& surface, const Image* texture) const {
    const Vector3f light = eyeFromModel(camera).cast<float>().transpose() * lightDirection();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int row = source_[i];
      Corner& corner = corners[i];
      const float lit = std::clamp(normals.row(row).dot(light) + kLightReach, 0.f, 1.f);
      corner.lit = 1 - surface.shading * (1 - lit);
      if (texture) {
        corner.u = uv_(Eigen::Index(i), 0) * float(texture->width);
        corner.v = uv_(Eigen::Index(i), 1) * float(texture->height);
      } else {
        corner.rgb = surface.colors ? Vector3f(surface.colors->row(row)) : surface.plain_rgb;
      }
    }
  }

  template <bool kWires>
  void drawTriangle(Samples& samples, const Corner& first, const Corner& second, const Corner& third,
                    const Surface& surface, const Image* texture) const {
    if (first.near <= 0 || second.near <= 0 || third.near <= 0) return;
    const std::array<const Corner*, 3> c = {&first, &second, &third};
    const Vector2f origin = first.at;  // keeps the numbers small
    std::array<Vector2f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = c[k]->at - origin;
    float area = p[1].x() * p[2].y() - p[1].y() * p[2].x();
    // Outwards is counter-clockwise, which on the screen, y down, is a negative area.
    if (area == 0 || !std::isfinite(area) || (area > 0 && solid_ && surface.fill)) return;
    const float sign = area > 0 ? 1.f : -1.f;
    area *= sign;

    const auto low = [&](int axis) { return std::min({p[0][axis], p[1][axis], p[2][axis]}) + origin[axis]; };
    const auto high = [&](int axis) { return std::max({p[0][axis], p[1][axis], p[2][axis]}) + origin[axis]; };
    const int x0 = std::max(samples.x0, int(std::ceil(low(0) - kReach)));
    const int x1 = std::min(samples.x0 + samples.width - 1, int(std::floor(high(0) + kReach)));
    const int y0 = std::max(samples.y0, int(std::ceil(low(1) - kReach)));
    const int y1 = std::min(samples.y0 + samples.height - 1, int(std::floor(high(1) + kReach)));
    if (x0 > x1 || y0 > y1) return;

    // Edge functions, 0 on the edge across from corner k and 1 at the corner: the corners' shares, one a
    // lane.
    Lanes ax = {}, ay = {}, constant = {};
    const float scale = sign / area;
    for (int k = 0; k < 3; ++k) {
      const Vector2f &from = p[std::size_t((k + 1) % 3)], &to = p[std::size_t((k + 2) % 3)];
      ax[k] = -scale * (to.y() - from.y());
      ay[k] = scale * (to.x() - from.x());
      constant[k] = -(ax[k] * from.x() + ay[k] * from.y());
    }
    const Lanes reach = kReach * ((ax < 0 ? -ax : ax) + (ay < 0 ? -ay : ay));
    const Lanes offset0 = ax[0] * kSampleX + ay[0] * kSampleY, offset1 = ax[1] * kSampleX + ay[1] * kSampleY,
                offset2 = ax[2] * kSampleX + ay[2] * kSampleY;
    const float near0 = c[0]->near, near1 = c[1]->near, near2 = c[2]->near;
    const Lanes near_offset = near0 * offset0 + near1 * offset1 + near2 * offset2;
    Lanes px_of_share = {};
    if (kWires)
      for (int k = 0; k < 3; ++k) px_of_share[k] = 1 / std::max(std::hypot(ax[k], ay[k]), 1e-12f);
    const float wire = surface.wire_px / 2;
    const unsigned alpha = byte(255 * surface.opacity);

    for (int y = y0; y <= y1; ++y) {
      const Lanes row = ay * (float(y) - origin.y()) + constant;
      for (int x = x0; x <= x1; ++x) {
        Lanes share = row + ax * (float(x) - origin.x());
        if (bits(share < -reach)) continue;
        const std::size_t at = samples.at(x, y);
        const Lanes z = near0 * share[0] + near1 * share[1] + near2 * share[2] + near_offset;
        LaneMask seen = z > samples.nearest[at], on_wire = {};
        const bool inside = bits(share >= reach) == kAll;
        if (!inside || kWires) {
          const Lanes e0 = share[0] + offset0, e1 = share[1] + offset1, e2 = share[2] + offset2;
          seen &= (e0 >= 0) & (e1 >= 0) & (e2 >= 0);
          if (kWires) {
            on_wire =
                (e0 * px_of_share[0] < wire) | (e1 * px_of_share[1] < wire) | (e2 * px_of_share[2] < wire);
            if (!surface.fill) seen &= on_wire;
          }
        }
        const unsigned seen_bits = bits(seen);
        if (seen_bits == 0) continue;
        samples.nearest[at] = seen ? z : samples.nearest[at];
        if (!inside) share += towardsSeen(seen_bits, ax, ay);
        const float s0 = std::max(0.f, share[0]) * near0, s1 = std::max(0.f, share[1]) * near1,
                    s2 = std::max(0.f, share[2]) * near2;
        const float all = 1 / (s0 + s1 + s2);
        const Pixel fill = colorAt(c, s0 * all, s1 * all, s2 * all, texture, alpha);
        std::array<Pixel, kSamples>& colors = samples.colors[at];
        if (kWires) {
          const Pixel ink = wireColor(fill, surface);
          for (int s = 0; s < kSamples; ++s)
            if (seen[s]) colors[std::size_t(s)] = on_wire[s] ? ink : fill;
        } else if (seen_bits == kAll) {
          colors = {fill, fill, fill, fill};
        } else {
          for (int s = 0; s < kSamples; ++s)
            if (seen_bits >> s & 1) colors[std::size_t(s)] = fill;
        }
      }
    }
  }

  // From the shares at the pixel's centre to those at the middle of the samples that are seen: that lies in
  // the triangle, the centre need not.
  static Lanes towardsSeen(unsigned seen_bits, const Lanes& ax, const Lanes& ay) {
    float x = 0, y = 0, count = 0;
    for (std::size_t s = 0; s < kSamples; ++s)
      if (seen_bits >> s & 1) x += kSamplePlaces[s][0], y += kSamplePlaces[s][1], ++count;
    return ax * (x / count) + ay * (y / count);
  }

  Pixel colorAt(const std::array<const Corner*, 3>& c, float s0, float s1, float s2, const Image* texture,
                unsigned alpha) const {
    const float lit = s0 * c[0]->lit + s1 * c[1]->lit + s2 * c[2]->lit;
    if (!texture) {
      Vector3f rgb = s0 * c[0]->rgb + s1 * c[1]->rgb + s2 * c[2]->rgb;
      rgb *= shadeOf(lit, rgb.minCoeff());
      return packed(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), alpha);
    }
    float u = s0 * c[0]->u + s1 * c[1]->u + s2 * c[2]->u, v = s0 * c[0]->v + s1 * c[1]->v + s2 * c[2]->v;
    if (repeat_) {
      u -= std::floor(u / float(texture->width)) * float(texture->width);
      v -= std::floor(v / float(texture->height)) * float(texture->height);
    }
    return texel(*texture, u - 0.5f, v - 0.5f, lit, alpha);
  }

  // Over the fill, if there is one.
  static Pixel wireColor(Pixel fill, const Surface& surface) {
    const Color& ink = surface.wire_color;
    if (!surface.fill) return packed(ink.r, ink.g, ink.b, ink.a);
    const float over = float(ink.a) / 255, alpha = over + surface.opacity * (1 - over);
    const float share = alpha > 0 ? over / alpha : 1;
    const auto mixed = [&](std::uint8_t wire, int k) {
      return byte(share * float(wire) + (1 - share) * float(channel(fill, k)));
    };
    return packed(mixed(ink.r, 0), mixed(ink.g, 1), mixed(ink.b, 2), byte(255 * alpha));
  }

  static void resolve(const Samples& samples, Image& image) {
    for (int y = samples.y0; y < samples.y0 + samples.height; ++y)
      for (int x = samples.x0; x < samples.x0 + samples.width; ++x) {
        const std::size_t at = samples.at(x, y);
        const unsigned seen = bits(samples.nearest[at] > 0);
        if (seen == 0) continue;
        const std::array<Pixel, kSamples>& s = samples.colors[at];
        unsigned alpha = 0, r = 0, g = 0, b = 0;
        if (seen == kAll && s[0] == s[1] && s[0] == s[2] && s[0] == s[3]) {
          r = channel(s[0], 0), g = channel(s[0], 1), b = channel(s[0], 2), alpha = channel(s[0], 3);
        } else {
          for (std::size_t i = 0; i < kSamples; ++i) {
            if (!(seen >> i & 1)) continue;
            const unsigned a = channel(s[i], 3);
            alpha += a;
            r += a * channel(s[i], 0), g += a * channel(s[i], 1), b += a * channel(s[i], 2);
          }
          if (alpha == 0) continue;
          const unsigned half = alpha / 2;
          r = (r + half) / alpha, g = (g + half) / alpha, b = (b + half) / alpha;
          alpha = (alpha + kSamples / 2) / kSamples;
        }
        std::uint8_t* p = image.pixel(x, y);
        p[0] = std::uint8_t(r), p[1] = std::uint8_t(g), p[2] = std::uint8_t(b), p[3] = std::uint8_t(alpha);
      }
  }

  Eigen::MatrixX3i triangles_;
  Eigen::Index vertex_count_;
  bool solid_;
  Vector3f ink_rgb_;
  Eigen::VectorXf ink_reach_m_;  // empty: no line around it
  // Parted where front and back wear different parts of the texture: triangles, and each corner's vertex.
  Eigen::MatrixX3i drawn_;
  std::vector<int> source_;
  Eigen::MatrixX2f uv_;
  bool repeat_ = false;
  std::vector<Image> levels_;  // the texture, each half as large as the one before
};

}  // namespace

std::unique_ptr<MeshPainter> softwarePainter(const TriangleMesh& mesh) {
  return std::make_unique<SoftwarePainter>(mesh);
}

}  // namespace skel
