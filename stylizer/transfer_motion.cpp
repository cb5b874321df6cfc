#include "stylizer/transfer_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "libskel/core/error.h"
#include "libskel/core/progress.h"

namespace skel {
namespace {

using Eigen::Index;

// So sure must both be of where they look.
constexpr double kFacing = 0.05;
constexpr double kMargin_px = 20;
// Mean poses whose bones point the same way within half a degree or so: there is no way between them.
constexpr double kSameDirections = 0.03;
// Phase correlation; own walks in the style of own runs, found well, have .9 and more.
constexpr double kInStep = 0.8;
constexpr double kStill = 0.25;  // of how far a limb's end moves in both

bool loops(const PoseMatrix& poses, const std::string& option) {
  return option == "auto" ? isLoop(poses) : option == "yes";
}

Eigen::VectorXd stride(const PoseMatrix& poses, const SkeletonTemplate& plan) {
  std::vector<int> feet;
  for (const TemplateLimb& limb : plan.limbs)
    if (limb.limb_class == JointClass::kLeg) feet.push_back(limb.joints[2]);
  return (poses.row(2 * feet[0]) - poses.row(2 * feet[1])).transpose();
}

// Whether the feet come apart and together again as in a walk.
bool steps(const PoseMatrix& poses, const SkeletonTemplate& plan) {
  constexpr double kStep = 0.15;  // of the figure's height; a dance on the spot has .1, half a step .25
  const Eigen::VectorXd apart = stride(poses, plan);
  double low = poses(1, 0), high = low;
  for (Index r = 1; r < poses.rows(); r += 2)
    low = std::min(low, poses(r, 0)), high = std::max(high, poses(r, 0));
  return apart.maxCoeff() - apart.minCoeff() > kStep * (high - low);
}

// How far a limb's end moves, seen from where it begins.
double swing(const PoseMatrix& poses, const TemplateLimb& limb) {
  Eigen::AlignedBox2d box;
  for (Index f = 0; f < poses.cols(); ++f)
    box.extend(Eigen::Vector2d(jointOf(poses, limb.joints[2], f) - jointOf(poses, limb.joints[0], f)));
  return box.diagonal().norm();
}

double correlation(Eigen::VectorXd a, Eigen::VectorXd b) {
  a.array() -= a.mean();
  b.array() -= b.mean();
  const double norm = a.norm() * b.norm();
  return norm > 0 ? a.dot(b) / norm : 1;
}

// How far `now` lies on the way from one to the other, by projection.
double shareOfWay(const PoseMatrix& from, const PoseMatrix& to, const PoseMatrix& now,
                  const SkeletonTemplate& plan) {
  const auto mean = [&](const PoseMatrix& poses) {
    return Eigen::VectorXd(boneDirections(poses, plan).rowwise().mean());
  };
  const Eigen::VectorXd a = mean(from), way = mean(to) - a;
  return way.norm() > kSameDirections ? (mean(now) - a).dot(way) / way.squaredNorm() : 1;
}

Eigen::RowVectorXd lowestFoot(const PoseMatrix& poses, const SkeletonTemplate& plan) {
  Eigen::RowVectorXd y = Eigen::RowVectorXd::Constant(poses.cols(), -INFINITY);
  for (const TemplateLimb& limb : plan.limbs)
    if (limb.limb_class == JointClass::kLeg) y = y.cwiseMax(poses.row(2 * limb.joints[2] + 1));
  return y;
}

// The content's body with other bones: its lengths, its way, its feet as far from the ground as they were.
MotionFile asMotion(const PoseMatrix& canonical, const PoseMatrix& content, const MotionFile& source,
                    const std::string& path, const SkeletonTemplate& plan) {
  PoseMatrix poses =
      posesFromBones(boneDirections(canonical, plan), boneLengths(content, plan), content.topRows(2), plan);
  const Eigen::RowVectorXd off = lowestFoot(content, plan) - lowestFoot(poses, plan);
  for (Index r = 1; r < poses.rows(); r += 2) poses.row(r) += off;
  Eigen::Vector2d low, high;
  for (Index axis = 0; axis < 2; ++axis) {
    low(axis) = high(axis) = poses(axis, 0);
    for (Index r = axis; r < poses.rows(); r += 2) {
      low(axis) = std::min(low(axis), poses.row(r).minCoeff());
      high(axis) = std::max(high(axis), poses.row(r).maxCoeff());
    }
  }
  MotionFile motion;
  motion.frame_rate = source.frame_rate;
  motion.action = source.action;
  const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2 * kMargin_px);
  if (!(size.maxCoeff() <= kLongestMotionSide_px))
    throw InputError(path, "would leave a frame of " + std::to_string(kLongestMotionSide_px) +
                               " px in this style; scale its joints down, or give less --amount");
  for (Index f = 0; f < poses.cols(); ++f) {
    MotionFrame frame;
    frame.image_width = int(std::ceil(size.x()));
    frame.image_height = int(std::ceil(size.y()));
    frame.time_s = source.frames[std::size_t(f)].time_s;
    frame.key = source.frames[std::size_t(f)].key;
    for (std::size_t j = 0; j < plan.joints.size(); ++j)
      frame.joints.push_back(PlacedJoint{
          jointOf(poses, int(j), f) - low + Eigen::Vector2d::Constant(kMargin_px), 1, JointOrigin::kDerived});
    motion.frames.push_back(std::move(frame));
  }
  return motion;
}

const NamedMotion* ofClass(const std::vector<NamedMotion>& motions, const std::string& action) {
  for (const NamedMotion& m : motions)
    if (m.motion.action == action) return &m;
  return nullptr;
}

}  // namespace

MotionTransferReport transferMotion(const std::vector<NamedMotion>& content,
                                    const std::vector<NamedMotion>& style,
                                    const MotionTransferOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  // One pair an action that both show; two motions alone are one pair, whatever they are called.
  std::vector<std::pair<const NamedMotion*, const NamedMotion*>> matched;
  if (content.size() == 1 && style.size() == 1) {
    matched.emplace_back(&content[0], &style[0]);
  } else {
    for (const NamedMotion& c : content) {
      const bool again = std::any_of(matched.begin(), matched.end(), [&](const auto& pair) {
        return pair.first->motion.action == c.motion.action;
      });
      const NamedMotion* s = again ? nullptr : ofClass(style, c.motion.action);
      if (s) matched.emplace_back(&c, s);
    }
    if (matched.empty())
      throw InputError(style[0].path, "shows no action that the content shows; theirs is \"" +
                                          style[0].motion.action + "\", the content's \"" +
                                          content[0].motion.action + "\"");
  }
  MotionTransferReport report;
  std::vector<MotionPair> pairs;
  std::vector<std::string> actions;
  PoseMatrix first_content;
  for (const auto& [c, s] : matched) {
    const PoseMatrix ours = posesOf(c->motion, plan, c->path);
    PoseMatrix theirs = posesOf(s->motion, plan, s->path);
    const double facing_ours = facing(ours, plan), facing_theirs = facing(theirs, plan);
    const bool mirror = options.mirror == MirrorStyle::kAlways ||
                        (options.mirror == MirrorStyle::kAutomatic && facing_ours * facing_theirs < 0 &&
                         std::min(std::abs(facing_ours), std::abs(facing_theirs)) > kFacing);
    if (mirror) theirs = mirroredPoses(theirs, plan);
    MotionPair pair{canonicalPoses(ours, plan),
                    canonicalPoses(theirs, plan),
                    loops(ours, options.loop),
                    loops(theirs, options.loop),
                    c->path,
                    s->path};
    for (std::size_t f = 0; f < c->motion.frames.size(); ++f)
      if (c->motion.frames[f].key) pair.keys.push_back(int(f));
    // Two poses tell nothing of a motion.
    if (pair.keys.size() < 3 || options.by_signatures) pair.keys.clear();
    requireFewPoses(pair.keys.empty() ? pair.content.cols() : Index(pair.keys.size()), c->path);
    if (options.by_signatures) requireFewPoses(pair.style.cols(), s->path);
    if (pairs.empty()) {
      first_content = ours;
      report.mirrored = mirror;
      report.content_loops = pair.content_loops;
      report.style_loops = pair.style_loops;
    }
    pairs.push_back(std::move(pair));
    actions.push_back(c->motion.action);
  }
  TransferOptions how = options.transfer;
  ProgressBar bar("transfer", pairs.size() * kPhaseBeginnings + how.coding.iterations());
  how.on_beginning = how.coding.on_iteration = [&] { bar.advance(); };
  const Transfer transfer =
      options.by_signatures ? transferBySignatures(pairs, actions, how) : transferStyle(pairs, how);
  report.error = transfer.coding.error;
  const PoseMatrix& poses = transfer.poses[0];
  report.phase_correlation = correlation(stride(poses, plan), stride(pairs[0].content, plan));
  report.steps = steps(pairs[0].content, plan) && steps(pairs[0].style, plan);
  report.mean_pose_moved = shareOfWay(pairs[0].content, pairs[0].style, poses, plan);
  for (const TemplateLimb& limb : plan.limbs) {
    const double least = std::min(swing(pairs[0].content, limb), swing(pairs[0].style, limb));
    if (swing(poses, limb) < kStill * least)
      report.still.push_back(plan.joints[std::size_t(limb.joints[2])].name);
  }
  report.motion = asMotion(poses, first_content, matched[0].first->motion, matched[0].first->path, plan);
  const auto nameOf = [](const NamedMotion& m) { return m.motion.source.empty() ? m.path : m.motion.source; };
  report.motion.source = nameOf(*matched[0].first) + " in the style of " + nameOf(*matched[0].second);
  return report;
}

std::vector<std::string> transferNotes(const MotionTransferReport& report) {
  std::vector<std::string> notes;
  char number[16];
  std::snprintf(number, sizeof number, "%.2f", report.phase_correlation);
  if (report.steps && report.phase_correlation < kInStep)
    notes.push_back(
        std::string("the feet do not keep the content's time (phase correlation ") + number +
        "): in one of the two, left and right are probably taken for each other; a film of more frames a "
        "second may tell, else look at them by skel-style inspect, and mend joints by skel-label");
  for (const std::string& joint : report.still)
    notes.push_back(joint + " hardly moves, though it does in both");
  return notes;
}

}  // namespace skel
