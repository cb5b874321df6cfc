// A trunk and a skirt are about as round as they are wide.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// Least heights of the inner vertices, px: 0 away from trunk and skirt.
Eigen::VectorXd leastHeights(const PlanarMesh& mesh, const DepthSections& sections);

}  // namespace skel
