#include "libskel/pipeline/trunk_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "libskel/layers/part_net.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kSections = 40, kSectionsMixed = 2;  // to both sides
constexpr double kTrunkRound = 0.62;               // depth by width
constexpr double kMostTrunk = 1.8;                 // half depth, of the trunk's half width about its middle
constexpr double kAtSide = 0.4;                    // of its half width, off the spine: one that swings

// Across the spine.
struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  bool empty() const { return least > most; }
};

DepthEllipse meanOf(const std::vector<Extent>& extents, int first, int last) {
  DepthEllipse mean;
  int count = 0;
  for (int k = std::max(0, first); k <= std::min(kSections, last); ++k) {
    const Extent& extent = extents[static_cast<std::size_t>(k)];
    if (extent.empty()) continue;
    mean.middle_px += (extent.least + extent.most) / 2, mean.half_px += (extent.most - extent.least) / 2;
    ++count;
  }
  if (count > 0) mean.middle_px /= count, mean.half_px /= count;
  return mean;
}

}  // namespace

std::optional<DepthSections> trunkSections(const Plane8& parts, const Plane8& figure,
                                           const TrunkJoints& joints) {
  if (parts.size() == 0) return std::nullopt;
  const Vector2d down = (joints.pelvis - joints.neck).normalized(), across(-down.y(), down.x());
  const double top = joints.neck.dot(down), middle = joints.pelvis.dot(across);
  const PixelBox box = figureBox(figure);
  const auto eachBelowNeck = [&](const auto& visit) {
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) {
        const auto part = static_cast<Part>(parts(y, x));
        if (figure(y, x) == 0 || (part != Part::kTrunk && part != Part::kSkirt)) continue;
        if (const Vector2d p(x, y); p.dot(down) >= top) visit(p);
      }
  };
  double bottom = top;
  eachBelowNeck([&](const Vector2d& p) { bottom = std::max(bottom, p.dot(down)); });
  const double step = (bottom - top) / kSections;
  if (step < 0.5) return std::nullopt;
  std::vector<Extent> extents(kSections + 1);
  eachBelowNeck([&](const Vector2d& p) {
    Extent& extent = extents[static_cast<std::size_t>((p.dot(down) - top) / step)];
    extent.least = std::min(extent.least, p.dot(across));
    extent.most = std::max(extent.most, p.dot(across));
  });

  DepthSections sections{top * down, down, step, {}};
  const double to_body = std::max((joints.body - joints.neck).dot(down), step);
  for (int k = 0; k <= kSections; ++k) {
    DepthEllipse ellipse = meanOf(extents, k - kSectionsMixed, k + kSectionsMixed);
    // Shoulders are flat, and so is what swings to one side.
    const double half_px = std::max(ellipse.half_px, 1.),
                 aside = std::abs(ellipse.middle_px - middle) / half_px;
    const double round =
        kTrunkRound * std::min(k * step / to_body, 1.) * std::clamp(2 - aside / kAtSide, 0., 1.);
    ellipse.round = std::min(round, kMostTrunk * joints.trunk_px / half_px);
    sections.ellipses.push_back(ellipse);
  }
  return sections;
}

}  // namespace skel
