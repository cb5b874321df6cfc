// A skirt is as round as it is wide.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// Least heights of the inner vertices, px: 0 away from the skirt.
Eigen::VectorXd skirtHeights(const PlanarMesh& mesh, const DepthSkirt& skirt);

}  // namespace skel
