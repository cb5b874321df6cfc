#include "libskel/style/poses.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/error.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

Index rowsOf(const SkeletonTemplate& body_plan) { return 2 * Index(body_plan.joints.size()); }

// The joints of a limb from the trunk outwards bend to this side of the straight line through its ends, as a
// share of the limb's length; +x positive. 0 where the limb has no length.
double bend(const PoseMatrix& poses, const std::array<int, 3>& joints, Index frame) {
  const Vector2d from = jointOf(poses, joints[0], frame), middle = jointOf(poses, joints[1], frame),
                 to = jointOf(poses, joints[2], frame);
  const double length = (middle - from).norm() + (to - middle).norm();
  return length > 0 ? (middle.x() - 0.5 * (from.x() + to.x())) / length : 0;
}

}  // namespace

void requireFewPoses(Index count, const std::string& path) {
  if (count > kMostPoses)
    throw InputError(path, "has " + std::to_string(count) + " poses to make a style from; " +
                               std::to_string(kMostPoses) +
                               " are the most: mark fewer key frames (\"key\") or cut it");
}

PoseMatrix posesOf(const MotionFile& motion, const SkeletonTemplate& body_plan, const std::string& path) {
  const std::size_t frames = motion.frames.size();
  PoseMatrix poses(rowsOf(body_plan), Index(frames));
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
    const auto known = [&](std::size_t f) { return motion.frames[f].joints[j].has_value(); };
    std::size_t before = frames, after = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      if (known(f)) before = f;
      after = std::max(after, f);
      while (after < frames && !known(after)) ++after;
      if (before == frames && after == frames)
        throw InputError(path, "no frame knows the joint \"" + body_plan.joints[j].name +
                                   "\"; place it in one frame at least (skel-label)");
      const std::size_t a = before == frames ? after : before, b = after == frames ? before : after;
      const Vector2d from = motion.frames[a].joints[j]->image, to = motion.frames[b].joints[j]->image;
      const double span_s = motion.frames[b].time_s - motion.frames[a].time_s;
      const double t = span_s > 0 ? (motion.frames[f].time_s - motion.frames[a].time_s) / span_s : 0;
      poses.col(Index(f)).segment<2>(2 * Index(j)) = from + t * (to - from);
    }
  }
  return poses;
}

PoseMatrix boneDirections(const PoseMatrix& poses, const SkeletonTemplate& body_plan) {
  SKEL_CHECK_EQ(poses.rows(), rowsOf(body_plan));
  PoseMatrix directions = PoseMatrix::Zero(poses.rows(), poses.cols());
  for (Index f = 0; f < poses.cols(); ++f)
    for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
      const int parent = body_plan.joints[j].parent;
      if (parent < 0) continue;
      const Vector2d bone = jointOf(poses, int(j), f) - jointOf(poses, parent, f);
      const double length = bone.norm();
      Vector2d direction = bone / length;
      if (!(length > 1e-9)) direction = jointOf(directions, parent, f);
      if (direction.squaredNorm() == 0) direction = {0, -1};
      directions.col(f).segment<2>(2 * Index(j)) = direction;
    }
  return directions;
}

PoseMatrix posesFromBones(const PoseMatrix& directions, const Eigen::VectorXd& lengths,
                          const Eigen::Matrix2Xd& root, const SkeletonTemplate& body_plan) {
  SKEL_CHECK_EQ(directions.cols(), root.cols());
  SKEL_CHECK_EQ(lengths.size(), Index(body_plan.joints.size()));
  PoseMatrix poses(directions.rows(), directions.cols());
  for (Index f = 0; f < poses.cols(); ++f)
    for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
      const int parent = body_plan.joints[j].parent;
      const Vector2d at =
          parent < 0
              ? Vector2d(root.col(f))
              : Vector2d(jointOf(poses, parent, f) + lengths(Index(j)) * jointOf(directions, int(j), f));
      poses.col(f).segment<2>(2 * Index(j)) = at;
    }
  return poses;
}

Eigen::VectorXd boneLengths(const PoseMatrix& poses, const SkeletonTemplate& body_plan) {
  SKEL_CHECK(poses.cols() > 0);
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(Index(body_plan.joints.size()));
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
    const int parent = body_plan.joints[j].parent;
    if (parent < 0) continue;
    std::vector<double> all;
    for (Index f = 0; f < poses.cols(); ++f)
      all.push_back((jointOf(poses, int(j), f) - jointOf(poses, parent, f)).norm());
    std::nth_element(all.begin(), all.begin() + Index(all.size() / 2), all.end());
    lengths(Index(j)) = all[all.size() / 2];
  }
  const double least = std::max(1e-6, lengths.maxCoeff() / 1000);
  return lengths.cwiseMax(least);
}

PoseMatrix canonicalPoses(const PoseMatrix& poses, const SkeletonTemplate& body_plan) {
  PoseMatrix preset(poses.rows(), 1);
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j)
    preset.col(0).segment<2>(2 * Index(j)) = body_plan.joints[j].preset;
  Eigen::VectorXd lengths = boneLengths(preset, body_plan);
  // From the root to the end of the longest chain, stretched out.
  std::vector<double> reach(body_plan.joints.size(), 0);
  for (std::size_t j = 0; j < reach.size(); ++j)
    if (const int parent = body_plan.joints[j].parent; parent >= 0)
      reach[j] = reach[std::size_t(parent)] + lengths(Index(j));
  lengths /= 2 * *std::max_element(reach.begin(), reach.end());
  const PoseMatrix canonical = posesFromBones(boneDirections(poses, body_plan), lengths,
                                              Eigen::Matrix2Xd::Constant(2, poses.cols(), 0.5), body_plan);
  // A chain that is stretched out ends at the border, but for rounding.
  return canonical.cwiseMax(0).cwiseMin(1);
}

PoseMatrix mirroredPoses(const PoseMatrix& poses, const SkeletonTemplate& body_plan) {
  PoseMatrix mirrored(poses.rows(), poses.cols());
  // About the middle of all places, so that they stay among those there were.
  double low = INFINITY, high = -INFINITY;
  for (Index r = 0; r < poses.rows(); r += 2) {
    low = std::min(low, poses.row(r).minCoeff());
    high = std::max(high, poses.row(r).maxCoeff());
  }
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
    const Index other = 2 * Index(body_plan.joints[j].mirror);
    mirrored.row(2 * Index(j)) = (low + high) - poses.row(other).array();
    mirrored.row(2 * Index(j) + 1) = poses.row(other + 1);
  }
  return mirrored;
}

double facing(const PoseMatrix& poses, const SkeletonTemplate& body_plan) {
  double sum = 0;
  int count = 0;
  for (const TemplateLimb& limb : body_plan.limbs)
    for (Index f = 0; f < poses.cols(); ++f, ++count)
      sum += (limb.limb_class == JointClass::kLeg ? 1 : -1) * bend(poses, limb.joints, f);
  // A limb that is bent by a right angle, in the mean, is as sure as can be.
  return count > 0 ? std::clamp(sum / count / 0.35, -1., 1.) : 0;
}

bool isLoop(const PoseMatrix& poses) {
  const Index m = poses.cols();
  if (m < 4) return false;
  double longest = 0;
  for (Index f = 1; f < m; ++f) longest = std::max(longest, (poses.col(f) - poses.col(f - 1)).norm());
  return (poses.col(0) - poses.col(m - 1)).norm() <= 2 * longest;
}

}  // namespace skel
