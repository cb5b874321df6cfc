// Joints for what hangs on a figure, so that it can move a little behind it (animation/follow_through.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/edges.h"
#include "libskel/skin/falloff.h"

namespace skel {

// What hangs on a joint: where it begins and ends, model frame, m; its vertices, and how far along it each
// is, 0…1.
struct Hanging {
  std::string what;
  int carrier;
  Eigen::Vector3f from, to;
  std::vector<int> vertices;
  std::vector<float> along;
  float share = 1;  // of what moves its end, that the chain takes over
};

// Connected vertices that end free: from where they touch what the trunk or the head carries, along the
// surface. `weights`: those of all vertices. Nothing where they touch neither, are short, or stand on the
// ground, as a chair does.
std::optional<Hanging> hangingFrom(const TriangleMesh& mesh, const Edges& edges, const Skeleton& skeleton,
                                   const std::vector<int>& vertices, const JointWeights& weights);

// Two joints, one behind the other, at the skeleton's end. They take over what the carrier and the rest of
// the trunk moved, the more the farther along it a vertex is; what limbs move of it stays theirs. `weights`
// get two columns.
void hangOnChain(const TriangleMesh& mesh, const Hanging& hanging, Skeleton& skeleton, JointWeights& weights);

}  // namespace skel
