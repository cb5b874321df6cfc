#include "libskel/recognition/evidence.h"

#include <algorithm>
#include <cmath>

#include "libskel/candidates/candidates.h"
#include "libskel/recognition/bone_coverage.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {
namespace {

using Eigen::Vector2d;

double logOdds(double p) {
  constexpr double kLeast = 1e-3;
  p = std::clamp(p, kLeast, 1 - kLeast);
  return std::log(p / (1 - p));
}

// Which of the last nine inputs is 1.
int kindOf(const std::string& name, const SkeletonTemplate& body_plan) {
  const int joint = body_plan.find(name);
  if (joint == body_plan.head) return 0;
  if (joint == body_plan.body) return 1;
  for (const TemplateLimb& limb : body_plan.limbs)
    for (int k = 0; k < 3; ++k)
      if (limb.joints[static_cast<std::size_t>(k)] == joint)
        return (limb.limb_class == JointClass::kHand ? 3 : 6) + k;
  return 2;
}
constexpr int kOther = 2, kKinds = 9;

double depthAt(const DistanceField& distance, const Vector2d& p) {
  const auto x = std::clamp<long>(std::lround(p.x()), 0, distance.cols() - 1),
             y = std::clamp<long>(std::lround(p.y()), 0, distance.rows() - 1);
  return std::max(1.f, distance(y, x));
}

double lengthZ(double value, double mean, double deviation) {
  constexpr double kMost = 5;
  return deviation > 0 ? std::clamp((value - mean) / deviation, -kMost, kMost) : 0;
}

}  // namespace

Evidence evidenceOf(const TreeRecognition& found, const Plane8& mask, const JointNet& net,
                    const NetJoints& joints, const SkeletonTemplate& body_plan) {
  constexpr double kSide = kWorkingGridSize, kLargestLogit = 8, kLeastLikelihood = -8, kMostDisagreement = 3;
  const int count = joints.count();
  const auto at = [&](int j) -> const TreeJoint& { return found.joints[static_cast<std::size_t>(j)]; };
  const auto parentOf = [&](int j) { return joints.parent[static_cast<std::size_t>(j)]; };
  const auto mirrorOf = [&](int j) { return joints.mirrored[static_cast<std::size_t>(j)]; };
  const auto logLength = [&](int j) {
    return BoneLength::logOf((at(j).position - at(parentOf(j)).position).norm());
  };

  std::vector<std::pair<Vector2d, Vector2d>> bones;
  std::vector<double> mass_behind(static_cast<std::size_t>(count), 1);
  std::vector<bool> has_child(static_cast<std::size_t>(count), false);
  int body = 0;
  for (int j = 0; j < count; ++j) {
    const int parent = parentOf(j);
    if (parent < 0) body = j;
    bones.emplace_back(at(j).position, at(parent < 0 ? j : parent).position);
    if (parent < 0) continue;
    double& behind = mass_behind[static_cast<std::size_t>(parent)];
    behind = std::min(behind, at(j).mass);
    has_child[static_cast<std::size_t>(parent)] = true;
  }
  const DistanceField distance = distanceField(mask);
  const BoneCoverage coverage = boneCoverage(mask, bones);
  const double body_depth = depthAt(distance, at(body).position);
  const double figure_logit = std::clamp(found.figure_logit, -kLargestLogit, kLargestLogit);
  const double turned = found.turned != 0, from_side = body_plan.from_side;
  const double farthest = coverage.farthest / kSide;

  Evidence evidence;
  evidence.joints.setZero(count, static_cast<Eigen::Index>(kJointInputs.size()));
  double least_mass = 1, mean_mass = 0, most_disagreement = 0, mean_disagreement = 0, most_z = 0, mean_z = 0,
         most_outside = 0, mean_outside = 0, most_unlike = 0, mean_unlike = 0;
  int counted = 0, pairs = 0;
  for (int j = 0; j < count; ++j) {
    const TreeJoint& joint = at(j);
    const int parent = parentOf(j);
    double z = 0, proportion_z = 0;
    if (parent >= 0 && !net.bones.empty()) {
      const BoneLength& bone = net.bones[static_cast<std::size_t>(j)];
      z = lengthZ(logLength(j), bone.mean, bone.deviation);
      if (parentOf(parent) >= 0)
        proportion_z = lengthZ(logLength(j) - logLength(parent), bone.ratio_mean, bone.ratio_deviation);
    }
    const double outside = coverage.outside[static_cast<std::size_t>(j)];
    const double disagreement = std::min(joint.disagreement, kMostDisagreement);
    const bool middle = mirrorOf(j) == j;
    const double apart = middle ? .5 : (joint.position - at(mirrorOf(j)).position).norm() / kSide;
    const int kind = kindOf(joints.names[static_cast<std::size_t>(j)], body_plan);
    auto row = evidence.joints.row(j);
    row.head(20) << logOdds(joint.mass), logOdds(joint.rival), logOdds(joint.counterpart), joint.entropy,
        std::max(joint.likelihood, kLeastLikelihood), disagreement, z, std::abs(z), std::abs(proportion_z),
        outside, std::log(depthAt(distance, joint.position) / body_depth), apart,
        logOdds(parent < 0 ? joint.mass : at(parent).mass),
        logOdds(has_child[static_cast<std::size_t>(j)] ? mass_behind[static_cast<std::size_t>(j)]
                                                       : joint.mass),
        figure_logit, found.entropy, turned, coverage.uncovered, farthest, from_side;
    row(20 + kind) = 1;

    evidence.counts.push_back(kind != kOther);
    if (kind == kOther) continue;
    ++counted;
    least_mass = std::min(least_mass, joint.mass);
    mean_mass += logOdds(joint.mass);
    most_disagreement = std::max(most_disagreement, disagreement);
    mean_disagreement += disagreement;
    const double strange = std::max(std::abs(z), std::abs(proportion_z));
    most_z = std::max(most_z, strange);
    mean_z += strange;
    most_outside = std::max(most_outside, outside);
    mean_outside += outside;
    if (middle || parent < 0 || mirrorOf(j) < j) continue;
    const double unlike = std::abs(logLength(j) - logLength(mirrorOf(j)));
    most_unlike = std::max(most_unlike, unlike);
    mean_unlike += unlike;
    ++pairs;
  }
  const double n = std::max(counted, 1);
  evidence.figure.resize(static_cast<Eigen::Index>(kFigureInputs.size()));
  evidence.figure << figure_logit, found.entropy, turned, from_side, coverage.uncovered, farthest,
      logOdds(least_mass), mean_mass / n, most_disagreement, mean_disagreement / n, most_z, mean_z / n,
      most_outside, mean_outside / n, most_unlike, mean_unlike / std::max(pairs, 1),
      static_cast<double>((mask != 0).count()) / static_cast<double>(mask.size()),
      std::log(static_cast<double>(mask.rows()) / static_cast<double>(mask.cols()));
  static_assert(kJointInputs.size() == 20 + kKinds && kFigureInputs.size() == 18);
  return evidence;
}

}  // namespace skel
