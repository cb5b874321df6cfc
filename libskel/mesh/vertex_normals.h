// Smooth normals.
#pragma once

#include <Eigen/Core>

namespace skel {

// #V×3 unit vectors: the mean of the normals of the triangles around a vertex, weighted by their areas; +z
// where there is none. `triangles` index rows of `vertices`, counter-clockwise seen from outside.
Eigen::MatrixX3f vertexNormals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles);

}  // namespace skel
