// Axes of the joints for programs that draw bones: each joint's +y runs along the bone that it moves.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

bool isLeaf(const Skeleton& skeleton, int joint);

// What the joints of a model move.
struct MovedVertices {
  MovedVertices(const TriangleMesh& mesh, const SkinWeights& skin, const Skeleton& skeleton);
  std::vector<Eigen::Vector3d> bones;  // restBones()
  Eigen::Matrix3Xd places;             // by joint: of what it moves, in the mean by weight, m
  std::vector<bool> any;               // whether it moves something
  std::vector<std::vector<int>> most;  // the vertices that it moves first, ascending
  double ground_m = 0;                 // the lowest vertex
};

// Where the bone of a joint points in the rest pose, of any length: to the middle of its children; without
// children to its tail, if it has one, else on along its parent's bone, or flat above the ground where that
// would lead into it (feet): towards the vertices that it moves, or to the viewer.
Eigen::Vector3d boneDirection(const Skeleton& skeleton, int joint, const MovedVertices& moved);

// Of each joint the rotation from its own axes to the model's, in the rest pose: +y is boneDirection(), +z
// the side that is nearest to the viewer, so that knees and elbows bend about one axis. A joint that one of
// the clips stretches unevenly keeps the model's axes, since glTF scales along a node's own.
std::vector<Eigen::Quaterniond> boneAxes(const Skeleton& skeleton, const TriangleMesh& mesh,
                                         const SkinWeights& skin, const std::vector<Clip>& clips);

}  // namespace skel
