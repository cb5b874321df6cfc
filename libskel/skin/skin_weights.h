// Stage 8: which joints carry a vertex, and how much.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Four influences a vertex, heaviest first, weights sum to 1; unused ones are joint 0, weight 0.
struct SkinWeights {
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor>
      joints;                                                        // #V×4, indices into Skeleton::joints
  Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> weights;  // #V×4
};

enum class SkinMethod {
  kGeodesic,   // by distance from the bone measured inside the body
  kEuclidean,  // by distance through the air, for comparison
};

// All of them, and their names on the command line.
std::vector<SkinMethod> skinMethods();
std::string_view skinMethodName(SkinMethod method);

struct SkinOptions {
  int max_influences = 4;  // 1…4
};

// A joint moves the segment from itself to its child; a leaf owns a short tip segment beyond it; the head
// also owns the upper half of the segment that leads to it. Any mesh will do: open, in several parts.
// Vertices that no bone reaches take the weights of the nearest one that is reached.
SkinWeights computeSkinWeights(const TriangleMesh& mesh, const Skeleton& skeleton, SkinMethod method,
                               const SkinOptions& options = {});

}  // namespace skel
