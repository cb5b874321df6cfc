// Skin that motions do not stretch far.
#pragma once

#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/animation/figure_shape.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

inline constexpr double kMostStretch = 2.5;

struct StretchBound {
  int stretched = 0;  // triangles, still, above kMostStretch
  bool held_arms = false;
};

// Where one of the clips (of the rest pose) stretches a triangle above kMostStretch, weights change over a
// longer way: vertices about it move towards the mean of their neighbours until nothing is stretched so far.
// A single vertex that hangs on the wrong joint joins what is around it; where two parts merely touch, what
// lies between them gives, as far as needed and no farther. An arm that would tear the body rides with it if
// it is one piece with it (FigureShape::joined, kGrownArm) or tears much; other clips then suit the figure
// better (retargetToRest() of its new shape). Weights stay as SkinWeights wants them; nothing changes where
// nothing is stretched.
StretchBound boundStretch(const TriangleMesh& mesh, const Skeleton& skeleton,
                          const std::vector<double>& joined, const std::vector<Clip>& clips,
                          SkinWeights& weights);

}  // namespace skel
