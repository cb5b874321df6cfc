// From distances to weights.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skin/bones.h"

namespace skel {

// How far a bone is from a vertex, and how fast its weight falls beyond the nearest bone.
struct BoneReach {
  float distance_m2 = std::numeric_limits<float>::infinity();  // squared; infinite: no way
  float power_m2 = std::numeric_limits<float>::infinity();  // squared distance, less the square of how thick
                                                            // the body is about the bone
  float reach_m = 0;
};
// Says so of vertex v: `row` has a BoneReach() for each bone.
using ReachesOf = std::function<void(Eigen::Index v, std::vector<BoneReach>& row)>;

// From each vertex to each bone; infinite: no way.
using BoneDistances = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // #V×#bones

// #V×#joints, not negative, any sum. A row of zeros: no bone reaches the vertex.
using JointWeights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// How the bones of the trunk part among themselves.
enum class TrunkBones {
  kEach,     // like limbs from each other: the body of a drawing
  kOneLimb,  // like the bones of one limb: a spine of many bones, which runs on into the neck
};

// The nearest bone and those hardly farther share a vertex. Where bones meet end to end, the difference of
// the squared distances, d² − d_min², is the square of how far the vertex lies beyond the joint along the
// limb, whatever its place around the limb: a weight that is a function of it bends limbs like a joint.
// Powers part the limbs from the trunk and from each other, distances the bones of one limb: an upper arm,
// the thicker, would take the elbow with it by its power.
JointWeights weightsFromReaches(Eigen::Index vertices, const std::vector<Bone>& bones, int joint_count,
                                const ReachesOf& reaches_of, TrunkBones trunk = TrunkBones::kEach);

// How far beyond a joint the weights reach in a body of this half thickness, on a mesh with edges of this
// length.
float reachBeyondJoint(float radius_m, float edge_m);

// Mean length of the triangles' sides, m.
float meanEdge(const TriangleMesh& mesh);

}  // namespace skel
