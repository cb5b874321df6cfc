// A neck that is one from the side, too.
#pragma once

#include <Eigen/Core>

#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// By how much heights `z` of the inner vertices (px; solved for the whole body at once, which levels out a
// neck) are to be multiplied so that the throat is no deeper than it should be; 1 away from it.
Eigen::VectorXd neckProfile(const PlanarMesh& mesh, const Eigen::VectorXd& z, const DepthNeck& neck);

}  // namespace skel
