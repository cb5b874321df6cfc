// Draws a planned biped: body, hair, clothes, things held, in one of several drawing styles.
#pragma once

#include "trainer/figures/biped_plan.h"
#include "trainer/figures/scene.h"

namespace skel {

struct PaintedBiped {
  Scene scene;
  // head, body, then of the left and the right side shoulder, elbow, hand, hip, knee, foot.
  std::array<Eigen::Vector2d, 14> joints;
};

PaintedBiped paintBiped(Rng& rng, const BipedPlan& plan);

}  // namespace skel
