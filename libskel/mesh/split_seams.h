// Formats that know one texture coordinate a vertex need two vertices where front and back meet.
#pragma once

#include <optional>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

struct SplitMesh {
  // Vertices, those of the whole mesh first, then the copies; triangles and uv. The texture stays where it
  // is.
  TriangleMesh mesh;
  std::vector<int> source;  // #V: of each vertex the one of the whole mesh that it is or copies
};

SplitMesh splitSeams(const TriangleMesh& mesh);

// The whole mesh that splitSeams() made `split` of, without its texture; none if that never was one.
std::optional<TriangleMesh> joinSeams(const TriangleMesh& split);

}  // namespace skel
