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
constexpr double kAsideReach = 2.5;  // radii around a leg; what lies further off, as a tail may, stays

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

double asideAt(const std::vector<DepthBone>& bones, const Eigen::Vector2d& p) {
  double weights = 0, aside = 0;
  for (const DepthBone& bone : bones) {
    if (bone.trunk) continue;
    const Eigen::Vector2d along = bone.to - bone.from;
    const double share = std::clamp((p - bone.from).dot(along) / std::max(along.squaredNorm(), 1e-9), 0., 1.);
    const double away = (p - bone.from - share * along).norm() / bone.radius_px;
    const double weight = 1 / (std::pow(away, 4) + 0.02);
    weights += weight;
    const double near = std::clamp((kAsideReach - away) / (kAsideReach - 1), 0., 1.);
    aside += weight * near * (bone.from_aside_px + share * (bone.to_aside_px - bone.from_aside_px));
  }
  return weights > 0 ? aside / weights : 0;
}

}  // namespace skel
