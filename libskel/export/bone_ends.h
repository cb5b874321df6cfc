// Joints at the ends of the last bones, for programs that take a bone's length from its child.
#pragma once

#include <string>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// Of the joint's end.
std::string boneEndName(const std::string& joint);

// `skeleton`, and behind its joints one more for each without children: at its tail, if it has one, else in
// the middle of the far end of what it moves (toes, fingertips, a snout), or, where that is moved more by
// others (a foot that is one with its leg), as far on as hands mostly reach. Those that move nothing
// (a hand that the drawing hides) get none, nor do those whose end's name is taken.
Skeleton withBoneEnds(const Skeleton& skeleton, const TriangleMesh& mesh, const SkinWeights& skin);

}  // namespace skel
