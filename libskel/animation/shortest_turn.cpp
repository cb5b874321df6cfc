#include "libskel/animation/shortest_turn.h"

#include <cmath>

namespace skel {

Eigen::Quaterniond shortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < -1 + 1e-12) {
    const Eigen::Vector3d axis = a.unitOrthogonal();
    return {0, axis.x(), axis.y(), axis.z()};
  }
  const Eigen::Vector3d axis = a.cross(b);
  const double length = std::sqrt((1 + cosine) * 2), inverse = 1 / length;
  Eigen::Quaterniond turn;
  turn.vec() = axis * inverse;
  turn.w() = length * 0.5;
  return turn;
}

}  // namespace skel
