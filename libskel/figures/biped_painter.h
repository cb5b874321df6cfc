// Draws a planned biped: body, hair, clothes, things held, in one of several drawing styles.
#pragma once

#include "libskel/figures/biped_plan.h"
#include "libskel/figures/scene.h"
#include "libskel/jointnet/net_joints.h"

namespace skel {

struct PaintedBiped {
  Scene scene;
  NetJointPositions joints;
};

PaintedBiped paintBiped(Rng& rng, const BipedPlan& plan);

}  // namespace skel
