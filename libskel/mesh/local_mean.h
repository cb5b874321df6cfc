// What a value on a planar mesh is around there.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/planar_mesh.h"

namespace skel {

// Of all vertices: the mean of `values` (of all, or of the inner vertices and 0 on the rim) over the mesh
// around each, with a bell of about `range_px` to each side that stays within the mesh.
Eigen::VectorXd localMean(const PlanarMesh& mesh, const Eigen::VectorXd& values, double range_px);

}  // namespace skel
