#include "libskel/recognition/facing_evidence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "libskel/core/segment.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr std::array kMiddle = {"body", "neck", "head", "head_top"};
constexpr std::array kPairs = {"shoulder", "elbow", "hand", "hip", "knee", "foot"};

// What lies nearest to the bones that begin at a joint, in x from it.
struct Carried {
  double left = 0, right = 0, sum = 0;
  int count = 0;

  double reach() const { return right - left; }
  double width() const { return right + left; }
  double middle() const { return count > 0 ? sum / count : 0; }
};

// Upright, x to the right and y up, image px.
struct UprightFigure {
  std::vector<Vector2d> joints, pixels;

  UprightFigure(const Skeleton& skeleton, const Silhouette& silhouette, double turned_rad) {
    const Eigen::Matrix2d upright =
        Eigen::Vector2d(1, -1).asDiagonal() * Eigen::Rotation2Dd(-turned_rad).toRotationMatrix();
    for (const Joint& joint : skeleton.joints) joints.push_back(upright * joint.image);
    const Plane8& mask = silhouette.grid_mask;
    for (Eigen::Index y = 0; y < mask.rows(); ++y)
      for (Eigen::Index x = 0; x < mask.cols(); ++x)
        if (mask(y, x) != 0)
          pixels.push_back(upright * silhouette.grid.imageFromGrid({double(x), double(y)}));
  }
};

std::vector<Carried> carriedBy(const UprightFigure& figure, const Skeleton& skeleton) {
  struct Bone {
    std::size_t joint;
    Vector2d from, to;
  };
  std::vector<Bone> bones;
  std::vector<bool> ends(skeleton.joints.size(), true);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (const int parent = skeleton.joints[j].parent; parent >= 0) {
      bones.push_back({std::size_t(parent), figure.joints[std::size_t(parent)], figure.joints[j]});
      ends[std::size_t(parent)] = false;
    }
  // What lies beyond the last bone is the end's.
  for (std::size_t j = 0; j < ends.size(); ++j)
    if (ends[j]) bones.insert(bones.begin(), {j, figure.joints[j], figure.joints[j]});
  std::vector<Carried> carried(skeleton.joints.size());
  for (const Vector2d& p : figure.pixels) {
    const Bone* nearest = nullptr;
    double least = 0;
    for (const Bone& bone : bones) {
      const double far = (nearestOnSegment<Vector2d>(p, bone.from, bone.to) - p).squaredNorm();
      if (nearest && far >= least) continue;
      nearest = &bone;
      least = far;
    }
    Carried& by = carried[nearest->joint];
    const double x = p.x() - figure.joints[nearest->joint].x();
    by.left = std::max(by.left, -x);
    by.right = std::max(by.right, x);
    by.sum += x;
    ++by.count;
  }
  return carried;
}

class Inputs {
 public:
  explicit Inputs(std::size_t count) : values_(static_cast<Eigen::Index>(count)) {}
  void add(double value) { values_[count_++] = value; }
  Eigen::VectorXd take() { return std::move(values_); }

 private:
  Eigen::VectorXd values_;
  Eigen::Index count_ = 0;
};

}  // namespace

std::optional<FacingEvidence> facingEvidence(const Skeleton& skeleton, const Silhouette& silhouette,
                                             double turned_rad) {
  const int pelvis = skeleton.find("pelvis");
  std::array<int, kMiddle.size()> middle;
  std::array<std::array<int, 2>, kPairs.size()> pairs;
  int least = pelvis;
  for (std::size_t i = 0; i < middle.size(); ++i)
    least = std::min(least, middle[i] = skeleton.find(kMiddle[i]));
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (int side = 0; side < 2; ++side)
      least = std::min(
          least, pairs[i][side] = skeleton.find((side == 0 ? "left_" : "right_") + std::string(kPairs[i])));
  if (least < 0) return std::nullopt;

  const UprightFigure figure(skeleton, silhouette, turned_rad);
  const auto [lowest, highest] =
      std::minmax_element(figure.pixels.begin(), figure.pixels.end(),
                          [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
  const double height = highest->y() - lowest->y() + 1;
  const auto at = [&](int joint) -> Vector2d { return figure.joints[std::size_t(joint)]; };
  const double trunk = (at(middle[1]) - at(pelvis)).norm() + .02 * height;
  const auto place = [&](int joint) -> Vector2d { return (at(joint) - at(pelvis)) / trunk; };
  // How far to the right the middle one of three joints lies of the line between the others.
  const auto bend = [&](std::size_t first, int side) {
    const Vector2d p = at(pairs[first + 1][side]);
    return (p - nearestOnSegment<Vector2d>(p, at(pairs[first][side]), at(pairs[first + 2][side]))).x() /
           trunk;
  };
  const std::vector<Carried> carried = carriedBy(figure, skeleton);
  const auto of = [&](int joint) -> const Carried& { return carried[std::size_t(joint)]; };
  const std::array<int, 4> trunk_joints = {middle[2], middle[1], middle[0], pelvis};
  const std::array<std::array<double, 2>, 2> bends = {{{bend(3, 0), bend(3, 1)}, {bend(0, 0), bend(0, 1)}}};
  const std::array<double, 2> feet = {of(pairs[5][0]).reach() / height, of(pairs[5][1]).reach() / height};

  Inputs sided(kSidedInputs.size()), unsided(kUnsidedInputs.size());
  for (const int joint : middle) sided.add(place(joint).x());
  sided.add((at(middle[2]) - at(middle[1])).x() / trunk);
  for (const auto& pair : pairs) sided.add(place(pair[0]).x() + place(pair[1]).x());
  for (const auto& both : bends) sided.add(both[0] + both[1]);
  sided.add(feet[0] + feet[1]);
  for (const int joint : trunk_joints) sided.add(of(joint).reach() / height);
  for (const int joint : trunk_joints) sided.add(of(joint).middle() / height);

  for (const int joint : middle) unsided.add(place(joint).y());
  for (const auto& pair : pairs) unsided.add(place(pair[0]).y() + place(pair[1]).y());
  for (const int axis : {0, 1})
    for (const auto& pair : pairs) unsided.add(std::abs((place(pair[0]) - place(pair[1]))[axis]));
  constexpr double kNarrow = .2;
  for (const std::size_t i : {0, 3}) unsided.add((place(pairs[i][0]) - place(pairs[i][1])).x());
  for (const std::size_t i : {0, 3})
    unsided.add(std::exp(-std::abs((place(pairs[i][0]) - place(pairs[i][1])).x()) / kNarrow));
  for (const auto& both : bends) unsided.add(std::max(std::abs(both[0]), std::abs(both[1])));
  unsided.add(std::max(std::abs(feet[0]), std::abs(feet[1])));
  for (const int joint : trunk_joints) unsided.add(of(joint).width() / height);
  unsided.add(trunk / height);
  return FacingEvidence{sided.take(), unsided.take()};
}

}  // namespace skel
