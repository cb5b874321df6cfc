// How well a joint net does on drawings with known joints.
#pragma once

#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/skeleton/template.h"
#include "trainer/jointed_drawing.h"

namespace skel {

// Means over the drawings; errors relative to the long side of the figure's box.
struct JointAccuracy {
  double within_5 = 0, within_10 = 0;  // share of the joints within 5 %, 10 %
  double usable = 0;                   // share of the drawings with every joint within 15 %
};

// By the whole recognition, as skel-infer does it.
JointAccuracy jointAccuracy(const std::vector<JointedDrawing>& drawings, const JointNet& net,
                            const SkeletonTemplate& body_plan, int threads);

}  // namespace skel
