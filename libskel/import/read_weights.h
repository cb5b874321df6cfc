// Skin weights, read back.
#pragma once

#include <string>

#include "libskel/export/write_character.h"

namespace skel {

// A .weights.json (format "skel-skin") for the mesh and the joints of `character`, whose joints it may name
// in any order. It has one entry for each vertex of the mesh, or for each of the file that the mesh was read
// from (TriangleMesh::file_vertex). Throws InputError with the JSON path: another number of vertices, or one
// that means both; a joint that the character lacks, negative weights, a vertex without any.
SkinWeights readWeights(const std::string& path, const RiggedCharacter& character);

}  // namespace skel
