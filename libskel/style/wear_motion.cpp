#include "libskel/style/wear_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/signed_angle.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

double legLength(const Eigen::VectorXd& lengths, const SkeletonTemplate& plan) {
  double sum = 0;
  for (const TemplateLimb& limb : plan.limbs)
    if (limb.limb_class == JointClass::kLeg) sum += lengths(limb.joints[1]) + lengths(limb.joints[2]);
  return sum;
}

// y of the foot that is further down.
Eigen::RowVectorXd lowest(const PoseMatrix& poses, const SkeletonTemplate& plan) {
  Eigen::RowVectorXd y = Eigen::RowVectorXd::Constant(poses.cols(), -INFINITY);
  for (const TemplateLimb& limb : plan.limbs)
    if (limb.limb_class == JointClass::kLeg) y = y.cwiseMax(poses.row(2 * limb.joints[2] + 1));
  return y;
}

}  // namespace

PoseMatrix wornBy(const PoseMatrix& rest, const PoseMatrix& motion, const SkeletonTemplate& plan,
                  const WearOptions& options) {
  SKEL_CHECK_EQ(rest.rows(), motion.rows());
  SKEL_CHECK_EQ(rest.cols(), 1);
  SKEL_CHECK(motion.cols() > 0);
  const Eigen::VectorXd lengths = boneLengths(rest, plan), theirs = boneLengths(motion, plan);
  PoseMatrix directions = boneDirections(motion, plan);
  const PoseMatrix drawn = boneDirections(rest, plan);
  // From the root up to where the arms begin.
  int top = 0;
  for (const TemplateLimb& limb : plan.limbs)
    if (limb.limb_class == JointClass::kHand) top = plan.joints[std::size_t(limb.joints[0])].parent;
  const auto trunk = [&](const PoseMatrix& poses, Index f) {
    return Vector2d(jointOf(poses, top, f) - jointOf(poses, 0, f));
  };
  const Vector2d upright = trunk(rest, 0);
  for (Index f = 0; f < motion.cols(); ++f) {
    const Vector2d now = trunk(motion, f);
    const double turn = signedAngle(upright, now);
    for (const TemplateLimb& limb : plan.limbs)
      directions.col(f).segment<2>(2 * limb.joints[0]) =
          Eigen::Rotation2Dd(turn) * jointOf(drawn, limb.joints[0], 0);
  }
  const double scale = legLength(lengths, plan) / legLength(theirs, plan);
  Eigen::Matrix2Xd root = jointOf(rest, 0, 0).replicate(1, motion.cols());
  if (options.travels) root.row(0).array() += scale * (motion.row(0).array() - motion(0, 0));
  PoseMatrix poses = posesFromBones(directions, lengths, root, plan);
  const Eigen::RowVectorXd ground = lowest(motion, plan);
  const Eigen::RowVectorXd off =
      lowest(rest, plan)(0) - lowest(poses, plan).array() + scale * (ground.array() - ground.maxCoeff());
  for (Index r = 1; r < poses.rows(); r += 2) poses.row(r) += off;
  return poses;
}

}  // namespace skel
