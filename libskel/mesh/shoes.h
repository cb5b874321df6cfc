// Feet that stand on the ground and have a length.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/mesh/body_depth.h"
#include "libskel/mesh/outline_band.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// The two sides of one piece of an inflated figure, px before and behind the drawing, of the inner vertices.
struct Heights {
  Eigen::VectorXd front, back;  // neither negative
};

// Draws out what is below each foot's ankle to a toe before and a heel behind it, over a flat sole: `place`,
// of all vertices, image px, comes down to the sole where it lies within a cell of it. Where an outline is
// drawn there, the sole shows (`band`.drawn) what lies past it, else it would be streaked with both. A foot
// that is long in the drawing gets no longer. What the outline covers above the sole stays as it is.
// `behind`: the width of the outline that the back shows, of the inner vertices.
void putOnShoes(const PlanarMesh& mesh, const std::vector<DepthFoot>& feet, const std::vector<double>& behind,
                OutlineBand& band, Heights& heights, std::vector<Eigen::Vector2d>& place);

}  // namespace skel
