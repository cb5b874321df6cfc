// Meshes that a program has made itself.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// Throws UsageError that begins with `name` and says which member is wrong: no vertices or triangles, a
// number that is not finite or a place beyond kFarthest, a triangle of vertices that there are not, lists
// that are neither empty nor one a vertex, a texture that is no picture.
void checkMesh(const TriangleMesh& mesh, const std::string& name);

}  // namespace skel
