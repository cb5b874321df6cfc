// Wavefront OBJ.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// A mesh of the user's own: polygons are cut into triangles, the texture named by its .mtl is read if there
// is one. Vertices keep the file's coordinates; model_from_image is the identity. Throws InputError with the
// line.
TriangleMesh readObj(const std::string& path);

}  // namespace skel
