// A motion on another body: bones point where they do in the motion, and are as long as they were drawn.
#pragma once

#include "libskel/style/poses.h"

namespace skel {

struct WearOptions {
  bool travels = true;  // goes where the motion goes; else stays at its place, but for ups and downs
};

// `motion`: 2J×m, px of its own pictures. `rest`: 2J×1, the joints of the other body, image px; the result is
// in the same px. Shoulders and hips are where the drawing has them, turned with the trunk. Ways are scaled
// by the length of the legs; the lower foot is as far above the ground as in the motion.
PoseMatrix wornBy(const PoseMatrix& rest, const PoseMatrix& motion, const SkeletonTemplate& body_plan,
                  const WearOptions& options = {});

}  // namespace skel
