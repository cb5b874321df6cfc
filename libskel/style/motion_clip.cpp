#include "libskel/style/motion_clip.h"

#include <cmath>
#include <numbers>

#include "libskel/core/check.h"

namespace skel {
namespace {

// The child that the joint's bone leads to: the next of its limb, or of the chain to the head; −1: it has
// none.
int boneEnd(const SkeletonTemplate& plan, int joint) {
  for (const TemplateLimb& limb : plan.limbs)
    for (std::size_t k = 0; k < 3; ++k)
      if (limb.joints[k] == joint) return k < 2 ? limb.joints[k + 1] : -1;
  for (int c = 0; c < int(plan.joints.size()); ++c) {
    bool in_limb = false;
    for (const TemplateLimb& limb : plan.limbs) in_limb = in_limb || limb.joints[0] == c;
    if (plan.joints[std::size_t(c)].parent == joint && !in_limb) return c;
  }
  return -1;
}

bool isLimb(const SkeletonTemplate& plan, int joint) {
  for (const TemplateLimb& limb : plan.limbs)
    for (const int j : limb.joints)
      if (j == joint) return true;
  return false;
}

}  // namespace

Clip clipOfMotion(const PoseMatrix& motion, const std::vector<double>& times_s, bool loops,
                  const SkeletonTemplate& plan, const std::string& name) {
  const Eigen::Index m = motion.cols();
  SKEL_CHECK(m > 0);
  SKEL_CHECK_EQ(std::size_t(m), times_s.size());
  Clip clip;
  clip.name = name;
  clip.template_name = plan.name;
  std::vector<float> times;
  for (const double t : times_s) times.push_back(float(t - times_s[0]));
  if (loops && m > 1) times.push_back(times.back() + times[1]);
  const PoseMatrix directions = boneDirections(motion, plan);
  const std::size_t joints = plan.joints.size();
  // How far each bone is turned from its canonical direction, counter-clockwise as seen; of a joint without a
  // bone, as its parent.
  Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(Eigen::Index(joints), m);
  for (std::size_t j = 0; j < joints; ++j) {
    const int end = boneEnd(plan, int(j)), parent = plan.joints[j].parent;
    if (end < 0) {
      if (parent >= 0) turns.row(Eigen::Index(j)) = turns.row(parent);
      continue;
    }
    const double up = isLimb(plan, int(j)) ? -1 : 1;
    for (Eigen::Index f = 0; f < m; ++f) {
      const Eigen::Vector2d d = jointOf(directions, end, f);
      // +y is down in the picture, up in the model.
      double turn = std::atan2(-up * d.x(), -up * d.y());
      if (f > 0)
        turn += 2 * std::numbers::pi *
                std::round((turns(Eigen::Index(j), f - 1) - turn) / (2 * std::numbers::pi));
      turns(Eigen::Index(j), f) = turn;
    }
    JointTrack track;
    track.joint = plan.joints[j].name;
    track.times_s = times;
    track.bone = {0, float(up), 0};
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Eigen::Index f = Eigen::Index(k) % m;
      const double local = turns(Eigen::Index(j), f) - (parent < 0 ? 0 : turns(parent, f));
      track.rotations.emplace_back(Eigen::AngleAxisf(float(local), Eigen::Vector3f::UnitZ()));
    }
    clip.tracks.push_back(std::move(track));
  }
  double height = 0;
  for (Eigen::Index f = 0; f < m; ++f) {
    const auto y = motion.col(f)(Eigen::seq(1, Eigen::last, 2));
    height = std::max(height, y.maxCoeff() - y.minCoeff());
  }
  if (!(height > 0)) return clip;
  clip.root_times_s = times;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Eigen::Vector2d way = (jointOf(motion, 0, Eigen::Index(k) % m) - jointOf(motion, 0, 0)) / height;
    clip.root_translations.emplace_back(float(way.x()), float(-way.y()), 0.f);
  }
  return clip;
}

}  // namespace skel
