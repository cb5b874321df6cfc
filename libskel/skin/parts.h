// The separate parts of a mesh, and those that follow another.
#pragma once

#include <vector>

#include "libskel/skin/bones.h"
#include "libskel/skin/falloff.h"
#include "libskel/skin/welding.h"

namespace skel {

struct MeshParts {
  std::vector<int> of_vertex;  // its part, numbered from 0 in the order of their first vertices
  int count = 0;
};

// What hangs together by triangles; vertices at the same place count as one. A vertex of no triangle is a
// part.
MeshParts meshParts(const TriangleMesh& mesh, const Welding& welding);

// For each part whether a bone lies in it: with the part on both sides of it along two of the axes. A bone in
// no part lies in all that are nearly as near to it as the nearest. One part has a bone at least.
std::vector<char> partsWithBones(const TriangleMesh& mesh, const MeshParts& parts,
                                 const std::vector<Bone>& bones);

// A part without a bone (an antler, a hat, an eye) follows, as a whole, the joint that carries most of what
// it touches: of the other part's vertices that are about as near to it as the nearest. Parts that touch
// nothing follow what is nearest.
void followTouchedParts(const TriangleMesh& mesh, const MeshParts& parts, const std::vector<char>& with_bones,
                        JointWeights& weights);

}  // namespace skel
