// How well a joint net does on drawings with known joints.
#pragma once

#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/skeleton/template.h"
#include "trainer/jointed_drawing.h"

namespace skel {

// Of one drawing, or the mean over several; errors relative to the long side of the figure's box.
struct JointAccuracy {
  double within_5 = 0, within_10 = 0;  // share of the joints within 5 %, 10 %
  double usable = 0;                   // share of the drawings with every joint within 15 %
};

// Of each drawing, by the whole recognition, as skel-infer does it; with a progress bar.
std::vector<JointAccuracy> jointAccuracies(const std::vector<JointedDrawing>& drawings, const JointNet& net,
                                           const SkeletonTemplate& body_plan, int threads);

JointAccuracy mean(const std::vector<JointAccuracy>& accuracies);

}  // namespace skel
