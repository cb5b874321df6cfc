#include "libskel/style/track_joints.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libskel/core/check.h"
#include "libskel/style/smooth_series.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

// Squared, in shares of the figure's long side. A joint that is plainly wrong in one frame costs no more than
// the cap, on whichever path.
constexpr double kVelocity = 0.4, kAcceleration = 1, kCap = 0.02;
constexpr double kColor = 0.02;  // for a squared difference of colours
// For a joint that has, of the two limbs' mean colours, the other's; as much less if its own. kColorNoise:
// deviation of a channel that tells nothing.
constexpr double kLook = 0.004, kColorNoise = 0.03;
constexpr int kLookRounds = 8;
constexpr double kSwap = 0.0001;     // for a joint that is not as recognised, times its confidence
constexpr double kOtherRoots = 0.9;  // so much shorter limbs have to be for roots to change sides
constexpr double kSpareLength = 1.35, kLengthFade = 0.2;
constexpr double kStray = 0.035;  // of the long side: so far from its way a joint is believed by half
constexpr double kFullRate = 24;  // frames a second, of TrackOptions::smoothness
constexpr int kRounds = 8;

// As seen, or with the names of the other side.
constexpr int kHypotheses = 2, kPairs = kHypotheses * kHypotheses;

// Which joints change names together: of arms and legs what crosses, and apart from them shoulders and hips,
// which stay where they are while legs cross.
struct LimbPart {
  JointClass limb_class;
  bool root;  // shoulder or hip
};
constexpr std::array<LimbPart, 4> kLimbParts = {{{JointClass::kHand, false},
                                                 {JointClass::kLeg, false},
                                                 {JointClass::kHand, true},
                                                 {JointClass::kLeg, true}}};

std::vector<int> jointsOf(const LimbPart& part, const SkeletonTemplate& plan) {
  std::vector<int> joints;
  for (const TemplateLimb& limb : plan.limbs) {
    if (limb.limb_class != part.limb_class) continue;
    if (part.root)
      joints.push_back(limb.joints[0]);
    else
      joints.insert(joints.end(), {limb.joints[1], limb.joints[2]});
  }
  return joints;
}

class Paths {
 public:
  Paths(const JointSightings& s, const SkeletonTemplate& plan, const LimbPart& part) : s_(s) {
    for (const int j : jointsOf(part, plan)) joints_.push_back({j, plan.joints[std::size_t(j)].mirror});
  }

  // One hypothesis a frame. What a limb looks like over all frames follows from the path, and the other way
  // round: in turns, until the path stays; from the path that knows no looks and from byColor(), of which the
  // cheaper one.
  std::vector<int> best() {
    const std::size_t m = std::size_t(s_.places.cols());
    if (m < 2) return std::vector<int>(m, 0);
    Path best = shortest();
    if (s_.colors.size() == 0) return best.hypotheses;
    best.cost = std::numeric_limits<double>::infinity();
    for (std::vector<int> start : {best.hypotheses, byColor()}) {
      Path path;
      for (int round = 0; round < kLookRounds && path.hypotheses != start; ++round) {
        if (round > 0) start = path.hypotheses;
        learnLooks(start);
        path = shortest();
      }
      if (path.cost < best.cost) best = path;
    }
    return best.hypotheses;
  }

 private:
  struct LimbJoint {
    int joint, mirror;
  };

  struct Path {
    std::vector<int> hypotheses;
    double cost = 0;
  };

  Path shortest() const {
    const int m = int(s_.places.cols());
    // Of a loop, the path goes round once more: its first frames then have a past as well.
    const int steps = s_.loop ? 2 * m : m;
    std::vector<std::array<double, kPairs>> cost(static_cast<std::size_t>(steps));
    std::vector<std::array<int, kPairs>> from(static_cast<std::size_t>(steps));
    for (int a = 0; a < kHypotheses; ++a)
      for (int b = 0; b < kHypotheses; ++b)
        cost[1][std::size_t(a * kHypotheses + b)] = alone(0, a) + alone(1, b) + step(0, a, 1, b);
    for (int t = 2; t < steps; ++t)
      for (int b = 0; b < kHypotheses; ++b)
        for (int c = 0; c < kHypotheses; ++c) {
          double least = std::numeric_limits<double>::infinity();
          int best_a = 0;
          for (int a = 0; a < kHypotheses; ++a) {
            const double sum = cost[std::size_t(t) - 1][std::size_t(a * kHypotheses + b)] +
                               bend((t - 2) % m, a, (t - 1) % m, b, t % m, c);
            if (sum < least) least = sum, best_a = a;
          }
          cost[std::size_t(t)][std::size_t(b * kHypotheses + c)] =
              least + alone(t % m, c) + step((t - 1) % m, b, t % m, c);
          from[std::size_t(t)][std::size_t(b * kHypotheses + c)] = best_a;
        }
    const auto& last = cost.back();
    int pair = int(std::min_element(last.begin(), last.end()) - last.begin());
    std::vector<int> path(static_cast<std::size_t>(steps));
    path.back() = pair % kHypotheses;
    for (int t = steps - 1; t >= 1; --t) {
      const int before = pair / kHypotheses;
      path[std::size_t(t) - 1] = before;
      if (t >= 2) pair = from[std::size_t(t)][std::size_t(pair)] * kHypotheses + before;
    }
    return {{path.end() - m, path.end()},
            last[std::size_t(path.back() + path[path.size() - 2] * kHypotheses)]};
  }

  // By the colours alone: the two limbs' difference in each frame along the direction in which it varies
  // most.
  std::vector<int> byColor() const {
    const Index m = s_.places.cols();
    Eigen::MatrixXd difference(3 * Index(joints_.size()), m);
    for (Index t = 0; t < m; ++t)
      for (std::size_t i = 0; i < joints_.size(); ++i)
        difference.col(t).segment<3>(3 * Index(i)) =
            s_.confidences(joints_[i].joint, t) * s_.confidences(joints_[i].mirror, t) *
            (color(joints_[i].joint, int(t)) - color(joints_[i].mirror, int(t)));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(difference * difference.transpose());
    const Eigen::VectorXd along = difference.transpose() * solver.eigenvectors().rightCols<1>();
    const bool most_negative = 2 * (along.array() < 0).count() > m;
    std::vector<int> path;
    for (Index t = 0; t < m; ++t) path.push_back((along(t) < 0) != most_negative);
    return path;
  }

  Eigen::Vector3d color(int joint, int t) const { return s_.colors.col(t).segment<3>(3 * joint); }

  // The mean colour of each joint on a path.
  void learnLooks(const std::vector<int>& path) {
    looks_ = Eigen::Matrix3Xd::Zero(3, s_.confidences.rows());
    for (const LimbJoint& j : joints_) {
      double weight = 1e-9;
      for (std::size_t t = 0; t < path.size(); ++t) {
        const int k = seen(j, path[t]);
        const double w = s_.confidences(k, Index(t));
        looks_.col(j.joint) += w * color(k, int(t));
        weight += w;
      }
      looks_.col(j.joint) /= weight;
    }
  }

  int seen(const LimbJoint& j, int hypothesis) const { return hypothesis ? j.mirror : j.joint; }

  double alone(int t, int hypothesis) const {
    double sum = 0;
    for (const LimbJoint& j : joints_) {
      const int k = seen(j, hypothesis);
      if (hypothesis) sum += kSwap * s_.confidences(j.joint, t);
      if (looks_.cols() == 0) continue;
      const double own = (color(k, t) - looks_.col(j.joint)).squaredNorm(),
                   others = (color(k, t) - looks_.col(j.mirror)).squaredNorm();
      sum += kLook * s_.confidences(k, t) * (own - others) / (own + others + 3 * kColorNoise * kColorNoise);
    }
    return sum;
  }
  double step(int t0, int a, int t1, int b) const {
    double sum = 0;
    for (const LimbJoint& j : joints_) {
      const int k0 = seen(j, a), k1 = seen(j, b);
      const double w = std::sqrt(s_.confidences(k0, t0) * s_.confidences(k1, t1));
      const Vector2d d = (jointOf(s_.places, k1, t1) - jointOf(s_.places, k0, t0)) / s_.figure_px;
      sum += w * std::min(kVelocity * d.squaredNorm(), kCap);
      if (s_.colors.size() > 0) sum += w * kColor * (color(k1, t1) - color(k0, t0)).squaredNorm();
    }
    return sum;
  }
  double bend(int t0, int a, int t1, int b, int t2, int c) const {
    double sum = 0;
    for (const LimbJoint& j : joints_) {
      const int k0 = seen(j, a), k1 = seen(j, b), k2 = seen(j, c);
      const double w = std::cbrt(s_.confidences(k0, t0) * s_.confidences(k1, t1) * s_.confidences(k2, t2));
      const Vector2d d =
          (jointOf(s_.places, k0, t0) - 2 * jointOf(s_.places, k1, t1) + jointOf(s_.places, k2, t2)) /
          s_.figure_px;
      sum += w * std::min(kAcceleration * d.squaredNorm(), kCap);
    }
    return sum;
  }

  const JointSightings& s_;
  std::vector<LimbJoint> joints_;
  Eigen::Matrix3Xd looks_;  // a column a joint; empty as long as nothing is known
};

// How long the upper bones of a kind of limb are together, in all frames.
double upperBones(const PoseMatrix& places, const SkeletonTemplate& plan, JointClass limb_class) {
  double sum = 0;
  for (const TemplateLimb& limb : plan.limbs)
    for (Index f = 0; limb.limb_class == limb_class && f < places.cols(); ++f)
      sum += (jointOf(places, limb.joints[0], f) - jointOf(places, limb.joints[1], f)).norm();
  return sum;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + Index(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// J×m: how far each joint of a limb can be believed, given how long the bones are in most frames, on both
// sides.
Eigen::MatrixXd plausibility(const JointTracks& tracks, const SkeletonTemplate& plan) {
  Eigen::MatrixXd belief = Eigen::MatrixXd::Ones(tracks.confidences.rows(), tracks.confidences.cols());
  const Index m = tracks.places.cols();
  const auto length = [&](int a, int b, Index f) {
    return (jointOf(tracks.places, a, f) - jointOf(tracks.places, b, f)).norm();
  };
  const auto fades = [](double relative) {
    return relative <= kSpareLength ? 1 : std::exp(-std::pow((relative - kSpareLength) / kLengthFade, 2));
  };
  for (const JointClass limb_class : {JointClass::kHand, JointClass::kLeg}) {
    std::vector<double> upper, lower;
    for (const TemplateLimb& limb : plan.limbs)
      for (Index f = 0; limb.limb_class == limb_class && f < m; ++f) {
        upper.push_back(length(limb.joints[0], limb.joints[1], f));
        lower.push_back(length(limb.joints[1], limb.joints[2], f));
      }
    if (upper.empty()) continue;
    const double u = std::max(1e-9, median(upper)), l = std::max(1e-9, median(lower));
    for (const TemplateLimb& limb : plan.limbs)
      for (Index f = 0; limb.limb_class == limb_class && f < m; ++f) {
        const auto& j = limb.joints;
        const double middle = fades(length(j[0], j[1], f) / u);
        belief(j[1], f) = middle;
        belief(j[2], f) = std::min(fades(length(j[0], j[2], f) / (u + l) * kSpareLength),
                                   std::max(middle, 0.3) * fades(length(j[1], j[2], f) / l));
      }
  }
  return belief;
}

}  // namespace

JointTracks trackJoints(const JointSightings& sightings, const SkeletonTemplate& body_plan,
                        const TrackOptions& options) {
  const Index joints = Index(body_plan.joints.size()), m = sightings.places.cols();
  SKEL_CHECK_EQ(sightings.places.rows(), 2 * joints);
  SKEL_CHECK_EQ(sightings.confidences.rows(), joints);
  SKEL_CHECK(sightings.figure_px > 0);
  JointTracks tracks{sightings.places, sightings.confidences, {}, {}};
  const auto swap = [&](const LimbPart& part, Index f) {
    for (const int j : jointsOf(part, body_plan)) {
      const int k = body_plan.joints[std::size_t(j)].mirror;
      if (j > k) continue;
      tracks.places.col(f).segment<2>(2 * j).swap(tracks.places.col(f).segment<2>(2 * k));
      std::swap(tracks.confidences(j, f), tracks.confidences(k, f));
    }
  };
  for (const LimbPart& part : kLimbParts) {
    const std::vector<int> path = Paths(sightings, body_plan, part).best();
    for (Index f = 0; f < m; ++f) {
      if (path[std::size_t(f)] != 0) swap(part, f);
      if (!part.root)
        (part.limb_class == JointClass::kLeg ? tracks.legs_swapped : tracks.arms_swapped)
            .push_back(path[std::size_t(f)] != 0);
    }
    if (!part.root) continue;
    // Which path of the roots belongs to which limbs: that for which the limbs are on their side most.
    const double as_found = upperBones(tracks.places, body_plan, part.limb_class);
    for (Index f = 0; f < m; ++f) swap(part, f);
    if (upperBones(tracks.places, body_plan, part.limb_class) < kOtherRoots * as_found) continue;
    for (Index f = 0; f < m; ++f) swap(part, f);
  }
  if (m < 3 || options.smoothness <= 0) return tracks;

  tracks.confidences.array() *= plausibility(tracks, body_plan).array();
  const double smoothness = options.smoothness * std::min(1., std::pow(sightings.frame_rate / kFullRate, 4));
  const PoseMatrix seen = tracks.places;
  for (Index j = 0; j < joints; ++j) {
    const int parent = body_plan.joints[std::size_t(j)].parent;
    Eigen::MatrixXd offsets = seen.middleRows(2 * j, 2).transpose();
    if (parent >= 0) offsets -= tracks.places.middleRows(2 * parent, 2).transpose();
    const Eigen::VectorXd confidence = tracks.confidences.row(j).transpose();
    Eigen::VectorXd weights = confidence.cwiseProduct(confidence);
    Eigen::MatrixXd smooth;
    // Geman & McClure (1985), by iteratively reweighted least squares: strays count less each round.
    for (int round = 0; round < kRounds; ++round) {
      // At first what a stray would drag along is held by its neighbours.
      const double strength = smoothness * (round + 1 < kRounds ? 3 : 1);
      smooth = smoothSeries(offsets, weights, strength, sightings.loop);
      const Eigen::VectorXd stray = (smooth - offsets).rowwise().norm() / (kStray * sightings.figure_px);
      weights = confidence.array().square() / (1 + stray.array().square()).square();
    }
    tracks.confidences.row(j) = (weights.array().sqrt()).transpose();
    tracks.places.middleRows(2 * j, 2) = smooth.transpose();
    if (parent >= 0) tracks.places.middleRows(2 * j, 2) += tracks.places.middleRows(2 * parent, 2);
  }
  return tracks;
}

double unevenness(const PoseMatrix& poses, double figure_px) {
  if (poses.cols() < 3) return 0;
  double sum = 0;
  int count = 0;
  for (Index f = 1; f + 1 < poses.cols(); ++f)
    for (Index j = 0; 2 * j < poses.rows(); ++j, ++count)
      sum += (jointOf(poses, int(j), f - 1) - 2 * jointOf(poses, int(j), f) + jointOf(poses, int(j), f + 1))
                 .norm();
  return sum / count / figure_px;
}

}  // namespace skel
