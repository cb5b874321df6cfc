// Three rings around a joint, one an axis, to turn it by.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "libskel/deform/skin_vertices.h"
#include "libskel/scene/scene.h"

namespace skel {

struct Ring {
  std::vector<Eigen::Vector2d> points;  // on the picture, px; closed
  std::vector<bool> in_front;           // of the joint, one a point
};

// About the joint's own axes as they stand in the pose (x, y, z), of that radius on the picture.
std::array<Ring, 3> jointRings(const Skeleton& skeleton, const JointTransforms& posed, int joint,
                               const Projection& projection, const Camera& camera, double radius_px);

// A ring that the mouse has taken hold of.
struct RingGrip {
  int axis = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();       // px
  Eigen::Vector2d per_rad = Eigen::Vector2d::Zero();  // where that point of the ring moves, px a radian

  // The angle that pulling the point to `px` turns the joint by.
  double angleTo(const Eigen::Vector2d& px) const;
};

// The nearest ring within `reach_px`; of several, the one in front.
std::optional<RingGrip> grip(const std::array<Ring, 3>& rings, const Eigen::Vector2d& px, double reach_px);

}  // namespace skel
