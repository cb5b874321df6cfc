// The methods behind SkinMethod: each is one file, one line here and one in skin_weights.cpp.
#pragma once

#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/falloff.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

struct SkinInput {
  const TriangleMesh& mesh;  // has vertices and triangles, all finite
  const Skeleton& skeleton;
  const std::vector<Bone>& bones;  // of the skeleton, at least one
  const SkinOptions& options;

  int jointCount() const { return static_cast<int>(skeleton.joints.size()); }
};

// Rows need not sum to 1; a row of zeros takes that of the nearest vertex.
using SkinFunction = JointWeights(const SkinInput& input);

SkinFunction geodesicWeights;
SkinFunction euclideanWeights;
SkinFunction heatWeights;
SkinFunction idwWeights;
SkinFunction idwRegionWeights;

}  // namespace skel
