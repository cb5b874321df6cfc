// Wavefront OBJ.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// A mesh of the user's own: polygons are cut into triangles, the texture named by its .mtl (map_Kd) is read
// if there is one; without texture coordinates, or with none for some corner, there is no texture. Vertices
// keep the file's coordinates, and are split where texture coordinates differ; model_from_image is the
// identity. Throws InputError with the line: numbers that are none, indices that lead nowhere, a .mtl or
// picture that cannot be read, no faces at all, a face of more than 10000 corners.
TriangleMesh readObj(const std::string& path);

}  // namespace skel
