// From distances to weights.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skin/bones.h"

namespace skel {

// #V×#bones, m; kUnreached where there is no way from the bone, or none that matters.
using BoneDistances = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
inline constexpr float kUnreached = std::numeric_limits<float>::infinity();

// #V×#joints, not negative, any sum. A row of zeros: no bone reaches the vertex.
using JointWeights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The nearest bone and those hardly farther share a vertex. Where limbs meet end to end, the difference of
// the squared distances, d² − d_min², is the square of how far the vertex lies beyond the joint along the
// limb, whatever its place around the limb: a weight that is a function of it bends limbs like a joint. The
// weight of the other bone ends where it lies as far beyond as the limb is thick.
JointWeights weightsFromDistances(const BoneDistances& distances, const std::vector<Bone>& bones,
                                  int joint_count, float edge_m);

// Mean length of the triangles' sides, m.
float meanEdge(const TriangleMesh& mesh);

// The radius of the part of the body that is nearest to each bone, m.
std::vector<float> boneRadii(const BoneDistances& distances);

}  // namespace skel
