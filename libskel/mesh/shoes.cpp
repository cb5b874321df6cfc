#include "libskel/mesh/shoes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skel {
namespace {

using Eigen::Vector2d;

// In radii of the shin.
constexpr double kFootReach = 3.5;  // of a foot to either side
constexpr double kAbove = 0.5;      // of the ankle
// The length of a shoe, in widths of the foot as it is drawn: if that lies evenly to both sides of the shin,
// and if it lies to one side alone (drawn from the side, or turned out).
constexpr double kLong = 1.6, kShort = 0.6;
constexpr double kMostByShin = 1.2;        // of the shin's length
constexpr double kToe = 0.7, kHeel = 0.3;  // before and behind the drawing, as shares of the length
constexpr double kHigh = 0.5;              // half as deep as high is the least
constexpr double kSole = 1.2;              // cells above the outline that are flattened
constexpr double kPastLine = 1.3;          // widths of the outline, what its blurred edge does not reach

// Across and down the shin, from the foot's joint.
struct FootFrame {
  Vector2d origin, down, across;
  explicit FootFrame(const DepthFoot& foot)
      : origin(foot.foot), down((foot.foot - foot.knee).normalized()), across(-down.y(), down.x()) {}
  Vector2d operator()(const Vector2d& p) const { return {(p - origin).dot(across), (p - origin).dot(down)}; }
};

}  // namespace

void putOnShoes(const PlanarMesh& mesh, const std::vector<DepthFoot>& feet, const std::vector<double>& behind,
                OutlineBand& band, Heights& heights, std::vector<Vector2d>& place) {
  // Of inner vertices of a sole with a line, the way from what it shows to the figure's edge.
  std::vector<Vector2d> past(static_cast<std::size_t>(mesh.inner_count), Vector2d::Zero());
  for (const DepthFoot& foot : feet) {
    if (foot.foot == foot.knee) continue;
    const FootFrame frame(foot);
    const double r = std::max(foot.radius_px, mesh.cell_px);
    std::vector<std::pair<int, Vector2d>> own;
    double sole = -std::numeric_limits<double>::infinity();
    for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
      const Vector2d& p = mesh.vertices[v];
      const Vector2d at = frame(p);
      if (std::abs(at.x()) > kFootReach * r || at.y() < -kAbove * r || at.y() > kFootReach * r) continue;
      const bool nearer = std::any_of(feet.begin(), feet.end(), [&](const DepthFoot& other) {
        return (p - other.foot).squaredNorm() < (p - foot.foot).squaredNorm();
      });
      if (nearer) continue;
      own.emplace_back(v, at);
      sole = std::max(sole, at.y());
    }
    const double height = sole + kAbove * r;
    if (own.size() < 6 || height < 2 * mesh.cell_px) continue;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (const auto& [v, at] : own)
      if (at.y() > sole - 0.6 * height) left = std::min(left, at.x()), right = std::max(right, at.x());
    const double width = right - left, middle = (left + right) / 2;
    if (width < 2 * mesh.cell_px) continue;
    const double aside = std::min(1.0, 2 * std::abs(middle) / width);
    const double long_px =
        std::min((kLong + aside * (kShort - kLong)) * width, kMostByShin * (foot.foot - foot.knee).norm());
    const double least = kHigh * std::min(width, height);
    const double toe = std::max(kToe * long_px, least);
    const double heel = std::max(kHeel * long_px, least);
    std::vector<std::pair<Vector2d, Vector2d>> rim;
    for (const auto& [a, b] : mesh.rim) {
      const Vector2d from = frame(mesh.vertices[a]), to = frame(mesh.vertices[b]);
      if (std::max(from.y(), to.y()) >= -kAbove * r) rim.emplace_back(from, to);
    }
    // How far down the shin the foot goes below a point.
    const auto soleBelow = [&](const Vector2d& at) {
      double there = at.y();
      for (const auto& [a, b] : rim) {
        if ((a.x() <= at.x()) == (b.x() <= at.x())) continue;
        const double y = a.y() + (b.y() - a.y()) * (at.x() - a.x()) / (b.x() - a.x());
        if (y <= sole) there = std::max(there, y);
      }
      return there;
    };
    for (const auto& [v, at] : own) {
      if (v >= mesh.inner_count) continue;
      const double line = band.width_px[static_cast<std::size_t>(v)];
      const double half = width / 2 - line;
      const double across = (at.x() - middle) / std::max(half, 1.0);
      const double round = std::sqrt(std::max(0.0, 1 - across * across));
      const double up = std::clamp((sole - at.y()) / height, 0.0, 1.0);
      const double instep = std::sqrt(1 - up * up), counter = std::sqrt(1 - std::pow(up, 4));
      const double drop = soleBelow(at) - at.y();
      // But for the sole, a drawn outline stays the flange that it is.
      const bool at_sole = drop < line + kSole * mesh.cell_px;
      if (line == 0 || at_sole) heights.front[v] = std::max(heights.front[v], round * toe * instep);
      if (behind[static_cast<std::size_t>(v)] == 0 || at_sole)
        heights.back[v] = std::max(heights.back[v], round * heel * counter);
      if (drop <= 0 || drop >= kSole * mesh.cell_px || round == 0) continue;
      place[static_cast<std::size_t>(v)] += 0.9 * drop * frame.down;
      // A light one is the sole's own.
      if (line == 0 || band.light[static_cast<std::size_t>(v)]) continue;
      past[static_cast<std::size_t>(v)] = kPastLine * line * frame.down;
      band.drawn[static_cast<std::size_t>(v)] =
          mesh.vertices[static_cast<std::size_t>(v)] + drop * frame.down - past[static_cast<std::size_t>(v)];
    }
  }
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}, {b, a}, {c, b}, {a, c}})
      if (from < mesh.inner_count && to >= mesh.inner_count && !past[std::size_t(from)].isZero())
        band.drawn[std::size_t(to)] = mesh.vertices[std::size_t(to)] - past[std::size_t(from)];
}

}  // namespace skel
