#include "libskel/deform/figure_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Flesh {
  const Eigen::MatrixX3f& vertices;
  const SkinWeights& weights;
  const Skeleton& skeleton;

  Vector3d at(Eigen::Index v) const { return vertices.row(v).transpose().cast<double>(); }
  const Vector3d& joint(int j) const { return skeleton.joints[j].position; }
  // How much of the vertex belongs to these joints.
  double share(Eigen::Index v, std::initializer_list<int> joints) const {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      if (std::find(joints.begin(), joints.end(), weights.joints(v, k)) != joints.end())
        sum += double(weights.weights(v, k));
    return sum;
  }
};

// The angle at which a stick that turns about `pivot` lies beside the trunk, seen from the front. `side`: 1
// for a limb that hangs to the right of the picture.
double hangBeside(const Flesh& flesh, std::initializer_list<int> trunk, const Vector3d& pivot, double length,
                  double half_width, double side) {
  double hang = 0;
  for (Eigen::Index v = 0; v < flesh.vertices.rows(); ++v) {
    const Vector3d from = flesh.at(v) - pivot;
    const double out = side * from.x(), down = -from.y(), far = std::hypot(out, down);
    if (out <= 0 || down <= 0 || far < 0.4 * length || far > length || flesh.share(v, trunk) < 0.8) continue;
    hang = std::max(hang, std::atan2(out, down) + 0.7 * std::asin(std::min(1.0, half_width / far)));
  }
  return hang;
}

// Half of the limb's thickness: how far its vertices lie from the bone, in the mean.
double halfWidth(const Flesh& flesh, int joint, int child) {
  double sum = 0;
  int seen = 0;
  const Vector2d from = flesh.joint(joint).head<2>(), to = flesh.joint(child).head<2>();
  for (Eigen::Index v = 0; v < flesh.vertices.rows(); ++v)
    if (flesh.share(v, {joint}) > 0.8) {
      sum += distanceToSegment<Vector2d>(flesh.at(v).head<2>(), from, to);
      ++seen;
    }
  return seen ? sum / seen : 0;
}

void measureArms(const Flesh& flesh, FigureShape& shape) {
  const Skeleton& skeleton = flesh.skeleton;
  const int pelvis = skeleton.find("pelvis"), body = skeleton.find("body"), neck = skeleton.find("neck");
  if (pelvis < 0 || body < 0 || neck < 0) return;
  for (const std::string name : {"left_", "right_"}) {
    const int shoulder = skeleton.find(name + "shoulder"), elbow = skeleton.find(name + "elbow"),
              hand = skeleton.find(name + "hand");
    if (shoulder < 0 || elbow < 0 || hand < 0) continue;
    const double side = flesh.joint(shoulder).x() < flesh.joint(0).x() ? -1 : 1;
    const double upper = (flesh.joint(elbow) - flesh.joint(shoulder)).norm(),
                 lower = (flesh.joint(hand) - flesh.joint(elbow)).norm();
    const double width = halfWidth(flesh, elbow, hand);
    const double hang =
        hangBeside(flesh, {pelvis, body, neck}, flesh.joint(shoulder), upper + 1.2 * lower, width, side);
    shape.hang_rad[shoulder] = shape.hang_rad[elbow] = shape.hang_rad[hand] = hang;
  }
}

void measureSoles(const Flesh& flesh, FigureShape& shape) {
  for (std::size_t j = 0; j < flesh.skeleton.joints.size(); ++j) {
    if (!flesh.skeleton.joints[j].name.ends_with("foot")) continue;
    double lowest = flesh.joint(int(j)).y();
    for (Eigen::Index v = 0; v < flesh.vertices.rows(); ++v)
      if (flesh.share(v, {int(j)}) > 0.5) lowest = std::min(lowest, double(flesh.vertices(v, 1)));
    shape.sole_y_m[j] = lowest;
  }
}

// How much further the foot reaches to the right of the picture than to the left of its joint, in heights.
double footReach(const Flesh& flesh, int foot, double height_m) {
  double left = 0, right = 0;
  for (Eigen::Index v = 0; v < flesh.vertices.rows(); ++v)
    if (flesh.share(v, {foot}) > 0.5) {
      const double x = double(flesh.vertices(v, 0)) - flesh.joint(foot).x();
      left = std::max(left, -x);
      right = std::max(right, x);
    }
  return (right - left) / height_m;
}

double bipedYaw(const Flesh& flesh, double height_m) {
  const Skeleton& skeleton = flesh.skeleton;
  const auto apart = [&](const char* joint) {
    const int left = skeleton.find("left_" + std::string(joint)),
              right = skeleton.find("right_" + std::string(joint));
    return left < 0 || right < 0 ? 1.0 : (flesh.joint(left).x() - flesh.joint(right).x()) / height_m;
  };
  const int left = skeleton.find("left_foot"), right = skeleton.find("right_foot");
  if (left < 0 || right < 0) return 0;
  const double a = footReach(flesh, left, height_m), b = footReach(flesh, right, height_m);
  if (std::getenv("SKEL_SHAPE"))
    std::printf("shape %.3f %.3f %.3f %.3f %.3f\n", apart("shoulder"), apart("hip"), a, b, height_m);
  return 0;
}

}  // namespace

FigureShape measureFigure(const Eigen::MatrixX3f& vertices, const SkinWeights& weights,
                          const Skeleton& skeleton) {
  SKEL_CHECK_EQ(vertices.rows(), weights.joints.rows());
  FigureShape shape = shapeOfBones(skeleton);
  shape.hang_rad.assign(skeleton.joints.size(), 0);
  shape.sole_y_m.assign(skeleton.joints.size(), 0);
  if (vertices.rows() == 0) return shape;
  shape.height_m = double(vertices.col(1).maxCoeff() - vertices.col(1).minCoeff());
  const Flesh flesh{vertices, weights, skeleton};
  measureSoles(flesh, shape);
  measureArms(flesh, shape);
  if (skeleton.find("left_front_foot") < 0) shape.yaw_rad = bipedYaw(flesh, shape.height_m);
  return shape;
}

}  // namespace skel
