// Edges of a planar mesh along a line that its grid knows nothing of.
#pragma once

#include <vector>

#include "libskel/mesh/planar_mesh.h"

namespace skel {

// A vertex that was put on an edge: at (1 − t)·a + t·b, where a and b are vertices of the mesh that came out,
// the level of a is negative and that of b positive.
struct CutVertex {
  int a, b;
  double t;
};

// `level`: of all vertices, linear on each edge. Cuts the triangles where it is zero, so that none is left
// with a negative and a positive corner. The new vertices, in the order of what is returned, become the last
// of the inner ones, those of the rim move up; edges of the rim are cut by nobody, and their ends must not
// differ in sign.
std::vector<CutVertex> cutMesh(PlanarMesh& mesh, const std::vector<double>& level);

}  // namespace skel
