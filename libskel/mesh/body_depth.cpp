// Blended by inverse distance (D. Shepard, "A two-dimensional interpolation function for irregularly-spaced
// data", 1968), in radii of the flesh around each bone.
#include "libskel/mesh/body_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/core/segment.h"

namespace skel {
namespace {

constexpr double kFlesh = 1.4;  // radii around a bone; what lies further off is cloth, hair or a brim
constexpr double kThinning = 1.5;

}  // namespace

DepthThere depthAt(const std::vector<DepthBone>& bones, const Eigen::Vector2d& p) {
  if (bones.empty()) return {};
  double weights = 0, source = 0, most = 0, forward = 0, nearest = std::numeric_limits<double>::infinity();
  for (const DepthBone& bone : bones) {
    const double away = distanceToSegment<Eigen::Vector2d>(p, bone.from, bone.to) / bone.radius_px;
    nearest = std::min(nearest, away);
    const double weight = 1 / (std::pow(away, 4) + 0.02);
    weights += weight;
    source += weight * bone.source;
    most += weight * bone.most_px;
    forward += weight * bone.forward;
  }
  return {source / weights, most / weights / std::pow(std::max(1.0, nearest / kFlesh), kThinning),
          forward / weights};
}

}  // namespace skel
