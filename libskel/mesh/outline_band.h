// The band along a figure's rim that its drawn outline covers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// A point of the figure's outline and how wide the dark line is that is drawn there.
struct OutlineSample {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // image px
  double width_px = 0;                              // 0: no line, or the figure is dark all the way through
  bool light = false;  // lighter than what it encloses: a white outline, the white of a sole
  Eigen::Vector2d inwards = Eigen::Vector2d::Zero();  // a unit vector; zero where the curve has no direction
};

// `outline`: closed curves of points about one px apart, the figure to the right of the way round as seen on
// the screen (sideMiddles() of a silhouette's). Looks inwards from every sample at the picture's
// inkLightness().
std::vector<OutlineSample> drawnOutline(const Image& image, const Plane8& mask,
                                        const std::vector<std::vector<Eigen::Vector2d>>& outline);

struct OutlineBand {
  std::vector<double> width_px;  // of the line, of each inner vertex that lies within it; 0 for all others
  std::vector<bool> light;       // of each inner vertex: OutlineSample::light of that line
  std::vector<Eigen::Vector2d> ink;    // of each of them, image px: a point in the middle of the line
  std::vector<Eigen::Vector2d> drawn;  // of all vertices, image px: the point of the drawing that they show
};

// Moves inner vertices that lie about a line's width from the rim onto the line's inner edge, as far as the
// triangles stay well shaped. From the side the line then is as thin as the mesh is at these vertices. They
// show the drawing a little further inwards, so that the blurred edge of the line stays on the band as well.
OutlineBand outlineBand(PlanarMesh& mesh, const std::vector<OutlineSample>& outline);

}  // namespace skel
