// What a value on a planar mesh is around there.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/planar_mesh.h"

namespace skel {

// Of all vertices: the mean of `inner` (of the inner vertices; 0 on the rim) over the mesh around each, with
// a bell of about `range_px` to each side that stays within the mesh.
Eigen::VectorXd localMean(const PlanarMesh& mesh, const Eigen::VectorXd& inner, double range_px);

}  // namespace skel
