#include "animator/handles.h"

#include <cmath>
#include <numbers>

#include "libskel/core/segment.h"

namespace skel {
namespace {

constexpr int kPoints = 64;

}  // namespace

std::array<Ring, 3> jointRings(const Skeleton& skeleton, const JointTransforms& posed, int joint,
                               const Projection& projection, const Camera& camera, double radius_px) {
  const auto j = std::size_t(joint);
  const Eigen::Vector3d center = (posed[j] * skeleton.joints[j].position.cast<float>()).cast<double>();
  const double radius = radius_px / projection.pxPerMetre(center);
  const Eigen::Vector3d to_eye = eyeFromModel(camera).transpose().col(2);
  std::array<Ring, 3> rings;
  for (int axis = 0; axis < 3; ++axis) {
    // Scaled joints have rings as round as others.
    const Eigen::Matrix3d turned = posed[j].linear().cast<double>();
    const Eigen::Vector3d u = turned.col((axis + 1) % 3).normalized(),
                          v = turned.col((axis + 2) % 3).normalized();
    Ring& ring = rings[std::size_t(axis)];
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kPoints;
      const Eigen::Vector3d out = std::cos(angle) * u + std::sin(angle) * v;
      ring.points.push_back(projection(center + radius * out).value_or(Eigen::Vector2d(-1e6, -1e6)));
      ring.in_front.push_back(out.dot(to_eye) > -0.05);
    }
  }
  return rings;
}

double RingGrip::angleTo(const Eigen::Vector2d& px) const {
  const double length2 = per_rad.squaredNorm();
  return length2 > 0 ? (px - at).dot(per_rad) / length2 : 0;
}

std::optional<RingGrip> grip(const std::array<Ring, 3>& rings, const Eigen::Vector2d& px, double reach_px) {
  std::optional<RingGrip> best;
  // What lies behind must be met more exactly.
  constexpr double kBehind = 2;
  for (int axis = 0; axis < 3; ++axis) {
    const Ring& ring = rings[std::size_t(axis)];
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Eigen::Vector2d &a = ring.points[i], &b = ring.points[(i + 1) % ring.points.size()];
      const double distance = distanceToSegment(px, a, b) * (ring.in_front[i] ? 1 : kBehind);
      if (distance >= reach_px) continue;
      reach_px = distance;
      best = RingGrip{axis, px, (b - a) * double(ring.points.size()) / (2 * std::numbers::pi)};
    }
  }
  // A ring that is seen edge-on would turn by a jump at its ends.
  if (best) {
    const double least = 15;
    const double length = best->per_rad.norm();
    if (length > 0 && length < least) best->per_rad *= least / length;
  }
  return best;
}

}  // namespace skel
