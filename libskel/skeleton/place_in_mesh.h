// Which way is up in a skeleton's file: as it lies in the mesh.
#pragma once

#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// (x, y, z) becomes (x, z, −y): from z up to y up, from facing −y to facing +z.
Skeleton yUpFromZUp(Skeleton skeleton);

// The share of the skeleton's joints and middles of bones that have the mesh on both sides of them, along at
// least two of the axes. Holes and faces that look inwards do little harm.
double shareInside(const Skeleton& skeleton, const TriangleMesh& mesh);

// For each point the groups of vertices (a number for each vertex) whose triangles lie on both
// sides of it along at least two of the axes.
std::vector<std::vector<int>> groupsAround(const std::vector<Eigen::Vector3d>& points,
                                           const TriangleMesh& mesh, const std::vector<int>& group_of_vertex);

}  // namespace skel
