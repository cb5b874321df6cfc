#include "libskel/animation/thin_keys.h"

#include <cmath>

namespace skel {

using Eigen::Quaterniond;
using Eigen::Vector3d;

std::vector<std::size_t> keysWithin(const Skeleton& skeleton, const std::vector<ModelPose>& poses,
                                    double tolerance_m) {
  constexpr std::size_t kFarthest = 10;
  const std::size_t count = skeleton.joints.size();
  std::vector<std::vector<Vector3d>> at;
  std::vector<std::vector<Quaterniond>> locals;
  for (const ModelPose& pose : poses) {
    at.push_back(jointPositions(skeleton, pose));
    locals.push_back(pose.globals);
    for (std::size_t j = 0; j < count; ++j)
      if (const int parent = skeleton.joints[j].parent; parent >= 0)
        locals.back()[j] = pose.globals[std::size_t(parent)].conjugate() * pose.globals[j];
  }
  // Leaves do not show in the joints' places: how far a hand would be off at its tip.
  constexpr double kTip_m = 0.1;
  const double most_turn = std::tan(tolerance_m / kTip_m);  // of half the angle
  const auto near = [&](std::size_t from, std::size_t to, std::size_t k) {
    const double t = double(k - from) / double(to - from);
    ModelPose between;
    between.root_offset_m = (1 - t) * poses[from].root_offset_m + t * poses[to].root_offset_m;
    between.globals.resize(count);
    for (std::size_t j = 0; j < count; ++j) {
      const Quaterniond local = locals[from][j].slerp(t, locals[to][j]);
      const Quaterniond off = local * locals[k][j].conjugate();
      if (off.vec().norm() > most_turn * std::abs(off.w())) return false;
      const int parent = skeleton.joints[j].parent;
      between.globals[j] = parent < 0 ? local : between.globals[std::size_t(parent)] * local;
    }
    const std::vector<Vector3d> places = jointPositions(skeleton, between);
    for (std::size_t j = 0; j < count; ++j)
      if (!((places[j] - at[k][j]).norm() <= tolerance_m)) return false;
    return true;
  };
  std::vector<std::size_t> keys = {0};
  while (keys.back() + 1 < poses.size()) {
    const std::size_t from = keys.back();
    std::size_t to = from + 1;
    while (to + 1 < poses.size() && to + 1 <= from + kFarthest) {
      // The middle is farthest off as a rule, and a jerk is at an end.
      if (!near(from, to + 1, (from + to + 1) / 2) || !near(from, to + 1, to) ||
          !near(from, to + 1, from + 1))
        break;
      ++to;
    }
    keys.push_back(to);
  }
  return keys;
}

}  // namespace skel
