#include "libskel/animation/figure_shape.h"

#include <algorithm>
#include <numbers>
#include <string>

#include "libskel/animation/bone_turn.h"

namespace skel {

using Eigen::Quaterniond;
using Eigen::Vector3d;

double joinedAt(const FigureShape& shape, int joint) {
  return shape.joined.empty() ? 0 : shape.joined[joint];
}

bool isSeated(const Skeleton& skeleton, const FigureShape& shape) {
  double straight = 0;
  for (const std::string side : {"left_", "right_"}) {
    const int hip = skeleton.find(side + "hip"), knee = skeleton.find(side + "knee"),
              foot = skeleton.find(side + "foot");
    if (hip < 0 || knee < 0 || foot < 0 || joinedAt(shape, foot) < 0.8) return false;
    const Vector3d upper = skeleton.joints[knee].position - skeleton.joints[hip].position,
                   lower = skeleton.joints[foot].position - skeleton.joints[knee].position;
    straight += std::max(0.0, -(upper + lower).y()) / std::max(1e-9, upper.norm() + lower.norm()) / 2;
  }
  return straight < 0.75;
}

bool isFolded(const Skeleton& skeleton, int elbow, int hand) {
  const Vector3d forearm = skeleton.joints[hand].position - skeleton.joints[elbow].position;
  const double inwards = -outwards(skeleton, elbow) * forearm.x();
  const double least = skeleton.joints[0].position.y() - 0.5 * forearm.norm();
  return inwards > 0.5 * forearm.norm() && skeleton.joints[hand].position.y() > least &&
         skeleton.joints[hand].position.y() < skeleton.joints[elbow].position.y() + 0.7 * forearm.norm();
}

double soleBelow(const FigureShape& shape, int foot, const Quaterniond& turn) {
  double lowest = 0;
  if (!shape.feet_m.empty())
    for (const Vector3d& point : shape.feet_m[foot]) lowest = std::min(lowest, (turn * point).y());
  return lowest;
}

FigureShape shapeOfBones(const Skeleton& skeleton) {
  FigureShape shape;
  const int head = skeleton.find("head");
  if (skeleton.find("left_front_foot") >= 0 && head >= 0 &&
      skeleton.joints[head].position.x() > skeleton.joints[0].position.x())
    shape.yaw_rad = std::numbers::pi;
  return shape;
}

}  // namespace skel
