// Motions of a figure of sticks whose joints are known.
#pragma once

#include <cmath>
#include <numbers>

#include "libskel/style/poses.h"

namespace skel {

inline const SkeletonTemplate& biped() {
  static const SkeletonTemplate plan = loadTemplate("biped");
  return plan;
}

struct Gait {
  int frames = 24;
  double cycles = 1, phase_rad = 0;
  double legs_rad = 0.5, arms_rad = 0.5;  // how far they swing
  double lean_rad = 0;                    // of the trunk, towards +x
  double reach_rad = 0;                   // of both arms, from straight down towards +x
  double size_px = 200;
};

// Seen from the side, walking towards +x.
inline PoseMatrix walker(const Gait& gait) {
  const SkeletonTemplate& plan = biped();
  PoseMatrix directions = PoseMatrix::Zero(34, gait.frames);
  Eigen::VectorXd lengths = Eigen::VectorXd::Constant(17, 0.1 * gait.size_px);
  for (int f = 0; f < gait.frames; ++f) {
    const double phase = 2 * std::numbers::pi * gait.cycles * f / gait.frames + gait.phase_rad;
    const auto set = [&](const std::string& joint, double from_down_rad) {
      directions.col(f).segment<2>(2 * plan.find(joint)) << std::sin(from_down_rad), std::cos(from_down_rad);
    };
    for (const char* joint : {"body", "neck", "head", "head_top"})
      set(joint, std::numbers::pi - gait.lean_rad);
    for (const std::string side : {"left_", "right_"}) {
      const double swing = std::sin(phase) * (side == "left_" ? 1 : -1);
      set(side + "shoulder", side == "left_" ? 1.4 : -1.4);
      set(side + "hip", side == "left_" ? 1.4 : -1.4);
      set(side + "elbow", gait.reach_rad - gait.arms_rad * swing);
      set(side + "hand", gait.reach_rad - gait.arms_rad * swing + 0.3);
      set(side + "knee", gait.legs_rad * swing);
      set(side + "foot", gait.legs_rad * swing - 0.2 + 0.2 * std::cos(phase) * (side == "left_" ? 1 : -1));
    }
  }
  lengths(plan.find("left_shoulder")) = lengths(plan.find("right_shoulder")) = 0.02 * gait.size_px;
  lengths(plan.find("left_hip")) = lengths(plan.find("right_hip")) = 0.02 * gait.size_px;
  return posesFromBones(directions, lengths, Eigen::Matrix2Xd::Constant(2, gait.frames, gait.size_px), plan);
}

// How far apart the feet are along x, a signal that goes round with the cycle.
inline Eigen::VectorXd stride(const PoseMatrix& poses) {
  return (poses.row(2 * biped().find("left_foot")) - poses.row(2 * biped().find("right_foot"))).transpose();
}

inline double correlation(Eigen::VectorXd a, Eigen::VectorXd b) {
  a.array() -= a.mean();
  b.array() -= b.mean();
  return a.dot(b) / (a.norm() * b.norm());
}

}  // namespace skel
