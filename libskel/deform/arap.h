// A flat mesh that is dragged by a few of its points, as rigidly as possible.
//
// T. Igarashi, T. Moscovich, J. Hughes, "As-rigid-as-possible shape manipulation" (2005): a first solve in
// which triangles may turn and scale freely (§4.1), a second one in which they have their own size back
// (§4.2). The second one is that of L. Liu et al., "A local/global approach to mesh parameterization" (2008),
// §4, repeated: triangles turn, then vertices follow, so that the energy never rises. Both matrices are
// factorised once. What is then still turned over, inside an elbow that is bent far, is mended by untangle.h.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "libskel/deform/untangle.h"

namespace skel {

struct ArapOptions {
  int iterations = 6;          // of the second solve, at least 1
  double handle_weight = 100;  // how much a handle's place counts beside a triangle's shape
};

class ArapMesh {
 public:
  // `vertices`: #V×2, `triangles`: #F×3, in one part, none of area 0, all of one orientation. `handles`:
  // #H×2, at least two that differ; one that lies in no triangle holds on to the nearest one's nearest point.
  // Throws UsageError where that is not so.
  ArapMesh(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
           const Eigen::MatrixX2d& handles, const ArapOptions& options = {});
  // The same with vertices as handles, for meshes that lie over themselves. A mesh in several parts needs two
  // in each.
  ArapMesh(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
           const std::vector<int>& handles, const ArapOptions& options = {});
  ~ArapMesh();
  ArapMesh(ArapMesh&&) noexcept;

  // #V×2 for handles at `targets`, #H×2. Depends on the targets alone, not on what was asked for before. May
  // be called from several threads.
  Eigen::MatrixX2d deform(const Eigen::MatrixX2d& targets) const;

  // Where the handles hold on: #H×2, of a mesh whose vertices are at `vertices`.
  Eigen::MatrixX2d handlesOf(const Eigen::MatrixX2d& vertices) const;

  struct Content;

 private:
  void prepare(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
               const std::vector<MeshHandle>& handles, const ArapOptions& options);
  std::unique_ptr<const Content> content_;
};

// Triangles whose orientation differs from that in `rest`.
int flippedTriangles(const Eigen::MatrixX2d& rest, const Eigen::MatrixX2d& posed,
                     const Eigen::MatrixX3i& triangles);

}  // namespace skel
