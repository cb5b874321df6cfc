// Skin that motions do not stretch far.
#pragma once

#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

inline constexpr double kMostStretch = 2.5;

// In one body of the mesh (TriangleMesh::layer).
struct HeldArm {
  int hand;
  int layer;
};

struct StretchBound {
  int stretched = 0;              // triangles, still, above kMostStretch
  std::vector<HeldArm> uprooted;  // if any, weights are what they were
};

// Where one of the clips (of the rest pose) stretches a triangle above kMostStretch, weights change over a
// longer way: they diffuse from vertex to vertex, each round harder along the edges of what is stretched
// still, and an edge farther around it. So what is stretched most in the end rides rigidly, and what lies
// about it gives, as far as needed and no farther. An arm that would give much of its weight to the body, or
// take of the body's, is uprooted: it is better held, and other clips then suit the figure. Weights stay as
// SkinWeights wants them, of at most so many joints a vertex (of one there is nothing to even out); nothing
// changes where nothing is stretched.
StretchBound boundStretch(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<Clip>& clips,
                          int max_influences, SkinWeights& weights);

// The arm rides with what it hangs on.
void holdArm(const TriangleMesh& mesh, const Skeleton& skeleton, const HeldArm& arm, SkinWeights& weights);

}  // namespace skel
