#include "trainer/figures/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/core/check.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

// Unit directions of a regular polygon that stands for a circle.
constexpr int kCircleCorners = 16;
const std::array<Vec, kCircleCorners>& circleDirections() {
  static const auto directions = [] {
    std::array<Vec, kCircleCorners> d;
    for (int i = 0; i < kCircleCorners; ++i) {
      const double a = 2 * std::numbers::pi * i / kCircleCorners;
      d[i] = {std::cos(a), std::sin(a)};
    }
    return d;
  }();
  return directions;
}

}  // namespace

PartOwner bearer(PartOwner owner) {
  switch (owner) {
    case PartOwner::kHair:
      return PartOwner::kHead;
    case PartOwner::kSkirt:
      return PartOwner::kTorso;
    case PartOwner::kAppendix:
      return PartOwner::kNone;
    default:
      return owner;
  }
}

void Scene::begin(const Ink& ink, PartOwner owner) {
  SKEL_CHECK(parts_.size() < 60000);
  parts_.push_back({ink, owner});
}

void Scene::addPiece(bool rim, int first) {
  SKEL_CHECK(!parts_.empty());
  pieces_.push_back({first, static_cast<int>(corners_.size()), static_cast<int>(parts_.size()) - 1, rim});
}

void Scene::disc(const Vec& centre, double radius) {
  for (const bool rim : {true, false}) {
    const double r = radius + (rim ? parts_.back().ink.rim_width : 0);
    if (rim && r == radius) continue;
    const int first = static_cast<int>(corners_.size());
    for (const Vec& d : circleDirections()) corners_.push_back(centre + r * d);
    addPiece(rim, first);
  }
}

void Scene::ellipse(const Vec& centre, const Vec& half_axes, double angle, double exponent) {
  const double c = std::cos(angle), s = std::sin(angle);
  constexpr int kCorners = 32;
  for (const bool rim : {true, false}) {
    const double w = rim ? parts_.back().ink.rim_width : 0;
    if (rim && w == 0) continue;
    const int first = static_cast<int>(corners_.size());
    for (int i = 0; i < kCorners; ++i) {
      const double a = 2 * std::numbers::pi * (i + 0.5) / kCorners;
      Vec d(std::cos(a), std::sin(a));
      if (exponent != 2) {
        d = {std::copysign(std::pow(std::abs(d.x()), 2 / exponent), d.x()),
             std::copysign(std::pow(std::abs(d.y()), 2 / exponent), d.y())};
      }
      d = {d.x() * (half_axes.x() + w), d.y() * (half_axes.y() + w)};
      corners_.push_back(centre + Vec(c * d.x() - s * d.y(), s * d.x() + c * d.y()));
    }
    addPiece(rim, first);
  }
}

void Scene::polygon(std::span<const Vec> corners) {
  const double w = parts_.back().ink.rim_width;
  if (w > 0) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec& a = corners[i];
      const Vec& b = corners[(i + 1) % corners.size()];
      int first = static_cast<int>(corners_.size());
      for (const Vec& d : circleDirections()) corners_.push_back(a + w * d);
      addPiece(true, first);
      const Vec along = b - a;
      const double length = along.norm();
      if (length < 1e-9) continue;
      const Vec n = Vec(-along.y(), along.x()) * (w / length);
      first = static_cast<int>(corners_.size());
      corners_.insert(corners_.end(), {a + n, b + n, b - n, a - n});
      addPiece(true, first);
    }
  }
  const int first = static_cast<int>(corners_.size());
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  addPiece(false, first);
}

void Scene::polygon(std::initializer_list<Vec> corners) {
  polygon(std::span<const Vec>(corners.begin(), corners.size()));
}

void Scene::path(std::span<const Vec> centres, std::span<const double> radii) {
  SKEL_CHECK_EQ(centres.size(), radii.size());
  for (const bool rim : {true, false}) {
    const double w = rim ? parts_.back().ink.rim_width : 0;
    if (rim && w == 0) continue;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      int first = static_cast<int>(corners_.size());
      for (const Vec& d : circleDirections()) corners_.push_back(centres[i] + (radii[i] + w) * d);
      addPiece(rim, first);
      if (i + 1 == centres.size()) break;
      const Vec along = centres[i + 1] - centres[i];
      const double length = along.norm();
      if (length < 1e-9) continue;
      const Vec n = Vec(-along.y(), along.x()) / length;
      first = static_cast<int>(corners_.size());
      corners_.insert(corners_.end(),
                      {centres[i] + n * (radii[i] + w), centres[i + 1] + n * (radii[i + 1] + w),
                       centres[i + 1] - n * (radii[i + 1] + w), centres[i] - n * (radii[i] + w)});
      addPiece(rim, first);
    }
  }
}

void Scene::line(const Vec& a, const Vec& b, double radius_a, double radius_b) {
  const Vec centres[] = {a, b};
  const double radii[] = {radius_a, radius_b};
  path(centres, radii);
}

void Scene::ring(const Vec& centre, double radius, double half_width) {
  constexpr int kCorners = 40;
  std::array<Vec, kCorners + 1> centres;
  std::array<double, kCorners + 1> radii;
  radii.fill(half_width);
  for (int i = 0; i <= kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    centres[i] = centre + radius * Vec(std::cos(a), std::sin(a));
  }
  path(centres, radii);
}

void Scene::transform(const std::function<Vec(const Vec&)>& move) {
  for (Vec& p : corners_) p = move(p);
}

Scene Scene::withoutDetails() const {
  Scene out = *this;
  std::erase_if(out.pieces_, [&](const Piece& piece) {
    const Part& part = parts_[piece.part];
    return part.ink.inside_only && part.owner == PartOwner::kNone;
  });
  return out;
}

void Scene::append(const Scene& front) {
  const int corners = static_cast<int>(corners_.size()), parts = static_cast<int>(parts_.size());
  corners_.insert(corners_.end(), front.corners_.begin(), front.corners_.end());
  parts_.insert(parts_.end(), front.parts_.begin(), front.parts_.end());
  for (Piece piece : front.pieces_) {
    piece.begin += corners;
    piece.end += corners;
    piece.part += parts;
    pieces_.push_back(piece);
  }
}

Scene::Box Scene::box() const {
  Box box{Vec::Constant(1e30), Vec::Constant(-1e30)};
  for (const Piece& piece : pieces_) {
    if (parts_[piece.part].ink.inside_only) continue;
    for (int i = piece.begin; i < piece.end; ++i) {
      box.low = box.low.cwiseMin(corners_[i]);
      box.high = box.high.cwiseMax(corners_[i]);
    }
  }
  return box;
}

Colour Raster::colour(int x, int y) const {
  const int i = y * width + x;
  if (part[i] == 0) return {255, 255, 255};
  const Ink& ink = parts[part[i] - 1].ink;
  if (rim[i]) return ink.rim;
  if (ink.stripe_period > 0 && (ink.stripes_upright ? x : y) % ink.stripe_period < ink.stripe_period / 2) {
    return ink.rim;
  }
  return ink.fill;
}

PartOwner Raster::owner(int x, int y) const {
  const int i = y * width + x;
  return part[i] == 0 ? PartOwner::kNone : parts[part[i] - 1].owner;
}

Raster rasterize(const Scene& scene, const Vec& low, double scale, int width, int height) {
  Raster raster{width, height, {}, {}, scene.parts_};
  raster.part.assign(static_cast<std::size_t>(width) * height, 0);
  raster.rim.assign(raster.part.size(), 0);

  // Crossings of one polygon with the rows' middle lines. More than kMaxCrossings on a row do not occur for
  // the shapes drawn here; further ones would be ignored in pairs.
  constexpr int kMaxCrossings = 12;
  std::vector<std::array<float, kMaxCrossings>> crossings(height);
  std::vector<int> count(height, 0);

  const auto fill = [&](const Scene::Piece& piece) {
    int row_low = height, row_high = -1;
    const int n = piece.end - piece.begin;
    const auto corner = [&](int i) -> Vec {
      return (scene.corners_[piece.begin + i] - low) * scale - Vec::Constant(0.5);
    };
    Vec a = corner(n - 1);
    for (int i = 0; i < n; ++i) {
      const Vec b = corner(i);
      const Vec& top = a.y() < b.y() ? a : b;
      const Vec& bottom = a.y() < b.y() ? b : a;
      const int first = std::max(0, static_cast<int>(std::ceil(top.y())));
      const int last = std::min(height - 1, static_cast<int>(std::ceil(bottom.y())) - 1);
      if (first <= last) {
        const double slope = (bottom.x() - top.x()) / (bottom.y() - top.y());
        for (int y = first; y <= last; ++y) {
          if (count[y] < kMaxCrossings) {
            crossings[y][count[y]++] = static_cast<float>(top.x() + slope * (y - top.y()));
          }
        }
        row_low = std::min(row_low, first);
        row_high = std::max(row_high, last);
      }
      a = b;
    }
    const Ink& ink = scene.parts_[piece.part].ink;
    const bool hole = ink.hollow && !piece.rim;
    const auto id = static_cast<std::uint16_t>(hole ? 0 : piece.part + 1);
    for (int y = row_low; y <= row_high; ++y) {
      std::sort(crossings[y].begin(), crossings[y].begin() + count[y]);
      for (int k = 0; k + 1 < count[y]; k += 2) {
        const int x0 = std::max(0, static_cast<int>(std::ceil(crossings[y][k])));
        const int x1 = std::min(width - 1, static_cast<int>(std::floor(crossings[y][k + 1])));
        for (int i = y * width + x0; i <= y * width + x1; ++i) {
          if (ink.inside_only && raster.part[i] == 0) continue;
          raster.part[i] = id;
          raster.rim[i] = piece.rim;
        }
      }
      count[y] = 0;
    }
  };

  // Of each part first the rim, then the inside.
  std::size_t begin = 0;
  while (begin < scene.pieces_.size()) {
    std::size_t end = begin;
    while (end < scene.pieces_.size() && scene.pieces_[end].part == scene.pieces_[begin].part) ++end;
    for (const bool rim : {true, false}) {
      for (std::size_t i = begin; i < end; ++i) {
        if (scene.pieces_[i].rim == rim) fill(scene.pieces_[i]);
      }
    }
    begin = end;
  }
  return raster;
}

}  // namespace skel
