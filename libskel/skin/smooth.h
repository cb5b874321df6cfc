// What is done to the weights of every method.
#pragma once

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skin/falloff.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// `rounds` times, all vertices at once move half way to the mean of their neighbours along edges. Vertices at
// one place are one. Rows that sum to 1 still do.
void smoothWeights(const TriangleMesh& mesh, int rounds, JointWeights& weights);

// The `count` heaviest of each row, to the sum of 1; of equal ones the first joints.
void keepHeaviest(int count, JointWeights& weights);

// Of rows with at most four weights above 0, heaviest first.
void packRow(const JointWeights& weights, Eigen::Index v, SkinWeights& result);
SkinWeights packWeights(const JointWeights& weights);
JointWeights unpackWeights(const SkinWeights& weights, int joint_count);

}  // namespace skel
