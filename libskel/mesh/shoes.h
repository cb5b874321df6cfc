// Feet that stand on the ground and have a length.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// The two sides of one piece of an inflated figure, px before and behind the drawing, of the inner vertices.
struct Heights {
  Eigen::VectorXd front, back;  // neither negative
};

// Draws out what is below each foot's ankle to a toe before and a heel behind it, over a flat sole: `place`,
// of all vertices, image px, comes down to the sole where it lies within a cell of it. A foot that is long in
// the drawing gets no longer. `band`: of the inner vertices, the width of a drawn outline, 0 off it.
void putOnShoes(const PlanarMesh& mesh, const std::vector<DepthFoot>& feet, const std::vector<double>& band,
                Heights& heights, std::vector<Eigen::Vector2d>& place);

}  // namespace skel
