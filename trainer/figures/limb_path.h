// The lines that limbs, tails, hair follow, with their thickness along the way.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "trainer/figures/biped_plan.h"

namespace skel {

inline constexpr double kThinnest = .0055;  // radius: a line of 1.4 px on a grid of 128
inline constexpr int kLimbPoints = 9;
using LimbPath = std::array<Eigen::Vector2d, kLimbPoints>;
using LimbRadii = std::array<double, kLimbPoints>;

inline Eigen::Vector2d normalised(const Eigen::Vector2d& v) {
  const double n = v.norm();
  return n > 1e-9 ? Eigen::Vector2d(v / n) : Eigen::Vector2d(0, 1);
}
inline double angleOf(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }
inline Eigen::Vector2d leftOf(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

// root → middle → end through all three, from sharp to round, with a sideways swing.
LimbPath limbPath(const LimbPlan& limb);
// An arc a → b → c of a thing that flows: hair, tails, scarves.
LimbPath flowing(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);
// Never thinner than kThinnest.
LimbRadii radiiThrough(double start, double middle, double end);

}  // namespace skel
