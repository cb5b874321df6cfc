// Draws a planned animal: trunk, legs, tail, neck, head, horns, wool, in one of several drawing styles.
#pragma once

#include <array>

#include "trainer/figures/quadruped_plan.h"
#include "trainer/figures/scene.h"

namespace skel {

struct PaintedQuadruped {
  Scene scene;
  // head, body, tail_root, tail, then of the left and the right side shoulder, elbow, front_foot, hip, knee,
  // hind_foot.
  std::array<Eigen::Vector2d, 16> joints;
};

// The animal faces the right of the picture or the left.
PaintedQuadruped paintQuadruped(Rng& rng, const QuadrupedPlan& plan);

}  // namespace skel
