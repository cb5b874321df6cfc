#include "libskel/deform/measure_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/parts.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Flesh {
  const TriangleMesh& mesh;
  const SkinWeights& weights;
  const Skeleton& skeleton;

  Vector3d at(Eigen::Index v) const { return mesh.vertices.row(v).transpose().cast<double>(); }
  const Vector3d& joint(int j) const { return skeleton.joints[j].position; }
  // How much of the vertex belongs to these joints.
  double share(Eigen::Index v, std::initializer_list<int> joints) const {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      if (std::find(joints.begin(), joints.end(), weights.joints(v, k)) != joints.end())
        sum += double(weights.weights(v, k));
    return sum;
  }
  // The joint that has more than half of the vertex; -1: none.
  int owner(Eigen::Index v) const {
    for (int k = 0; k < 4; ++k)
      if (const int joint = weights.joints(v, k); share(v, {joint}) > 0.5) return joint;
    return -1;
  }
};

// The angle at which a stick that turns about `pivot` lies beside the trunk, seen from the front. `side`: 1
// for a limb that hangs to the right of the picture.
double hangBeside(const Flesh& flesh, std::initializer_list<int> trunk, const Vector3d& pivot, double length,
                  double half_width, double side) {
  double hang = 0;
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v) {
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
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v)
    if (flesh.share(v, {joint}) > 0.8) {
      sum += distanceToSegment<Vector2d>(flesh.at(v).head<2>(), from, to);
      ++seen;
    }
  return seen ? sum / seen : 0;
}

// The share of the forearm, by its vertices, that hangs on the trunk or the legs: an arm that was drawn
// against the body, a hand that holds a skirt.
double joinedArm(const Flesh& flesh, int elbow, int hand) {
  const Vector2d from = flesh.joint(elbow).head<2>(), along = flesh.joint(hand).head<2>() - from;
  int arm = 0, joined = 0;
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v) {
    const double own = flesh.share(v, {elbow, hand});
    if (own < 0.2) continue;
    ++arm;
    if (own < 0.8 && (flesh.at(v).head<2>() - from).dot(along) > 0.3 * along.squaredNorm()) ++joined;
  }
  return arm ? double(joined) / arm : 1;
}

// FigureShape::taken of an arm: of the foremost vertices at places along its bones, and of those at the hand.
double takenAlong(const Flesh& flesh, int shoulder, int elbow, int hand, double height_m) {
  constexpr double kReach = 0.02;  // of the height
  constexpr int kPlaces = 5;       // of each of the three
  double sum = 0;
  int seen = 0;
  const auto look = [&](int from, int to, double way, int weight) {
    const Vector2d begin = flesh.joint(from).head<2>(), along = flesh.joint(to).head<2>() - begin;
    const Vector2d at = begin + way * along;
    Eigen::Index foremost = -1;
    for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v)
      if ((flesh.at(v).head<2>() - at).norm() < kReach * height_m &&
          (foremost < 0 || flesh.mesh.vertices(v, 2) > flesh.mesh.vertices(foremost, 2)))
        foremost = v;
    if (foremost < 0) return;
    sum += weight * flesh.share(foremost, {shoulder, elbow, hand});
    seen += weight;
  };
  for (int k = 1; k <= kPlaces; ++k) {
    const double t = double(k) / kPlaces;
    look(shoulder, elbow, t, 1);
    look(elbow, hand, t, 1);
    look(elbow, hand, 0.8 + 0.4 * t, 2);
  }
  return seen > 0 ? sum / seen : 1;
}

// The separate body of the mesh in which most of what these joints carry lies.
int bodyOf(const Flesh& flesh, const std::vector<int>& of_vertex, std::initializer_list<int> joints) {
  std::map<int, double> shares;
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v)
    if (const double share = flesh.share(v, joints); share > 0) shares[of_vertex[std::size_t(v)]] += share;
  const auto most = std::max_element(shares.begin(), shares.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == shares.end() ? -1 : most->first;
}

void measureArms(const Flesh& flesh, FigureShape& shape) {
  const Skeleton& skeleton = flesh.skeleton;
  const int pelvis = skeleton.find("pelvis"), body = skeleton.find("body"), neck = skeleton.find("neck");
  if (pelvis < 0 || body < 0 || neck < 0) return;
  const std::vector<int> bodies = meshParts(flesh.mesh, Welding(flesh.mesh.vertices)).of_vertex;
  const int trunk = bodyOf(flesh, bodies, {pelvis, body, neck});
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
    const bool apart = bodyOf(flesh, bodies, {elbow, hand}) != trunk;
    const double joined = !apart && isFolded(skeleton, elbow, hand) ? 1 : joinedArm(flesh, elbow, hand);
    const double taken = takenAlong(flesh, shoulder, elbow, hand, shape.height_m);
    shape.taken[shoulder] = shape.taken[elbow] = shape.taken[hand] = taken;
    shape.joined[shoulder] = shape.joined[elbow] = shape.joined[hand] = joined;
    shape.hang_rad[shoulder] = shape.hang_rad[elbow] = shape.hang_rad[hand] = hang;
  }
}

// Hair and brims may reach beyond it.
double headHalfWidth(const Flesh& flesh) {
  const int head = flesh.skeleton.find("head"), top = flesh.skeleton.find("head_top");
  if (head < 0) return 0;
  std::vector<double> away;
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v)
    if (flesh.share(v, {head, top}) > 0.8) away.push_back(std::abs(flesh.at(v).x() - flesh.joint(head).x()));
  if (away.empty()) return 0;
  const auto most = away.begin() + std::ptrdiff_t(0.85 * double(away.size()));
  std::nth_element(away.begin(), most, away.end());
  return *most;
}

// The length of the leg that ends there.
double legLength(const Flesh& flesh, int foot) {
  double length = 0;
  for (int joint = foot, bones = 0; bones < 2 && flesh.skeleton.joints[joint].parent >= 0; ++bones) {
    const int above = flesh.skeleton.joints[joint].parent;
    length += (flesh.joint(joint) - flesh.joint(above)).norm();
    joint = above;
  }
  return length;
}

// Of what each foot carries, the outermost points in so many directions of the picture.
void measureFeet(const Flesh& flesh, FigureShape& shape) {
  constexpr int kDirections = 16;
  constexpr double kReach = 0.6;  // of the leg's length; what is farther from the joint is not the foot
  struct Foot {
    double reach = -1;  // negative: no foot
    std::array<double, kDirections> farthest;
    std::vector<Vector3d> points;
  };
  std::vector<Foot> feet(flesh.skeleton.joints.size());
  for (std::size_t j = 0; j < feet.size(); ++j)
    if (flesh.skeleton.joints[j].name.ends_with("foot")) feet[j].reach = kReach * legLength(flesh, int(j));
  std::array<Vector2d, kDirections> directions;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDirections;
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v) {
    const int j = flesh.owner(v);
    if (j < 0) continue;
    Foot& foot = feet[std::size_t(j)];
    const Vector3d point = flesh.at(v) - flesh.joint(j);
    if (point.head<2>().norm() > foot.reach) continue;
    if (foot.points.empty()) {
      foot.points.resize(kDirections);
      foot.farthest.fill(-1e9);
    }
    for (int k = 0; k < kDirections; ++k) {
      const double far = point.x() * directions[k].x() + point.y() * directions[k].y();
      if (far > foot.farthest[k]) foot.farthest[k] = far, foot.points[k] = point;
    }
  }
  for (std::size_t j = 0; j < feet.size(); ++j)
    if (!feet[j].points.empty()) shape.feet_m[j] = std::move(feet[j].points);
}

// A pair of legs: what names its joints, and what both hang on.
struct LegPair {
  const char *top, *middle, *end, *trunk;
};
constexpr LegPair kBipedLegs = {"hip", "knee", "foot", "pelvis"};
constexpr LegPair kFrontLegs = {"shoulder", "elbow", "front_foot", "neck"};
constexpr LegPair kHindLegs = {"hip", "knee", "hind_foot", "pelvis"};

// How far down the leg the place is that is nearest to `p`: 0 at its top, 1 at its end.
double placeOnLeg(const std::array<Vector2d, 3>& leg, const Vector2d& p) {
  const double upper = (leg[1] - leg[0]).norm(), lower = (leg[2] - leg[1]).norm();
  const Vector2d on_upper = nearestOnSegment(p, leg[0], leg[1]),
                 on_lower = nearestOnSegment(p, leg[1], leg[2]);
  const double way = (on_upper - p).norm() < (on_lower - p).norm() ? (on_upper - leg[0]).norm()
                                                                   : upper + (on_lower - leg[1]).norm();
  return way / std::max(1e-9, upper + lower);
}

// How far down two legs are one piece: there, what lies between them goes with the trunk. However they are
// held: a raised leg reaches no less far down than the other.
void measureLegs(const Flesh& flesh, const LegPair& pair, FigureShape& shape) {
  const Skeleton& skeleton = flesh.skeleton;
  std::vector<int> joints;
  std::array<std::array<Vector2d, 3>, 2> legs;
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < 3; ++k) {
      joints.push_back(skeleton.find((side == 0 ? "left_" : "right_") +
                                     std::string(std::array{pair.top, pair.middle, pair.end}[k])));
      if (joints.back() < 0) return;
      legs[side][k] = flesh.joint(joints.back()).head<2>();
    }
  const int trunk = skeleton.find(pair.trunk);
  if (trunk < 0) return;
  double joined = 0;
  for (Eigen::Index v = 0; v < flesh.mesh.vertices.rows(); ++v)
    if (flesh.share(v, {trunk}) > 0.6) {
      const Vector2d p = flesh.at(v).head<2>();
      joined = std::max(joined, std::min(placeOnLeg(legs[0], p), placeOnLeg(legs[1], p)));
    }
  for (const int joint : joints) shape.joined[joint] = joined;
}

// What hangs belongs to what it hangs on.
SkinWeights ofCarriers(const SkinWeights& weights, const Skeleton& skeleton) {
  std::vector<std::uint16_t> carriers;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    carriers.push_back(static_cast<std::uint16_t>(carrierOf(skeleton, int(j))));
  SkinWeights carried = weights;
  carried.joints = carried.joints.unaryExpr([&](std::uint16_t joint) { return carriers[joint]; });
  return carried;
}

double heightOf(const TriangleMesh& mesh) {
  return double(mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff());
}

bool isBiped(const Skeleton& skeleton) { return skeleton.find("left_front_foot") < 0; }

}  // namespace

FigureShape measureFigure(const TriangleMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton,
                          const std::optional<Facing>& facing) {
  const auto& vertices = mesh.vertices;
  SKEL_CHECK_EQ(vertices.rows(), weights.joints.rows());
  FigureShape shape = shapeOfBones(skeleton);
  shape.hang_rad.assign(skeleton.joints.size(), 0);
  shape.feet_m.resize(skeleton.joints.size());
  shape.joined.assign(skeleton.joints.size(), 0);
  shape.taken.assign(skeleton.joints.size(), 1);
  if (vertices.rows() == 0) return shape;
  const SkinWeights carried = ofCarriers(weights, skeleton);
  shape.height_m = heightOf(mesh);
  const Flesh flesh{mesh, carried, skeleton};
  measureFeet(flesh, shape);
  if (isBiped(skeleton)) {
    measureArms(flesh, shape);
    shape.head_half_width_m = headHalfWidth(flesh);
    const Facing seen = facing.value_or(Facing());
    shape.yaw_rad = seen.yaw_rad;
    if (nearlyFlat(skeletonBones(skeleton))) shape.looks = seen.looks;
  } else if (facing) {
    shape.yaw_rad = std::remainder(facing->yaw_rad + std::numbers::pi / 2, 2 * std::numbers::pi);
  }
  for (const LegPair& pair : {kBipedLegs, kFrontLegs, kHindLegs}) measureLegs(flesh, pair, shape);
  return shape;
}

}  // namespace skel
