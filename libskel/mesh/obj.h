// Wavefront OBJ.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// A mesh of the user's own: polygons are cut into triangles, objects and groups become one mesh, normals are
// made anew. One material with a picture (map_Kd of its .mtl): that picture is the texture. Several: pictures
// and colours (Kd) become one texture side by side, a picture as often as its texture coordinates repeat it;
// faces without texture coordinates have their material's colour, faces without a material are white. All of
// it white: no texture. Vertices keep the file's coordinates and stand in the order of their `v` lines,
// without those of no face; where texture coordinates or materials differ they are split, and the copies
// follow in the order of the faces. TriangleMesh::file_vertex tells which line each is of; model_from_image
// is the identity. Throws InputError with the line: numbers that are none, indices that lead nowhere, a .mtl
// or picture that cannot be read, no faces at all, a face of more than 10000 corners.
TriangleMesh readObj(const std::string& path);

}  // namespace skel
