// Smooth normals.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// #V×3 unit vectors: the mean of the normals of the triangles around a vertex, weighted by their areas; +z
// where there is none.
Eigen::MatrixX3f vertexNormals(const TriangleMesh& mesh);

}  // namespace skel
