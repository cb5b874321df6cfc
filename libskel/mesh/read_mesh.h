// Models of the user's own.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// By the ending of its name: .obj (see obj.h). Throws InputError that says what to do with any other: .stl
// has neither parts nor colours.
TriangleMesh readMesh(const std::string& path);

}  // namespace skel
