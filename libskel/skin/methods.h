// The methods behind SkinMethod: each is one file, one line here and one in skin_weights.cpp.
#pragma once

#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/falloff.h"

namespace skel {

// The mesh has vertices and triangles. Rows need not sum to 1; a row of zeros takes that of the nearest
// vertex.
using SkinFunction = JointWeights(const TriangleMesh& mesh, const std::vector<Bone>& bones, int joint_count);

SkinFunction geodesicWeights;
SkinFunction euclideanWeights;

}  // namespace skel
