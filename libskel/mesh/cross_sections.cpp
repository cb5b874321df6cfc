#include "libskel/mesh/cross_sections.h"

#include <algorithm>
#include <cmath>

namespace skel {

Eigen::VectorXd leastHeights(const PlanarMesh& mesh, const DepthSections& sections) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(mesh.inner_count);
  const Eigen::Vector2d across(-sections.down.y(), sections.down.x());
  for (int v = 0; v < mesh.inner_count; ++v) {
    const Eigen::Vector2d d = mesh.vertices[static_cast<std::size_t>(v)] - sections.top;
    const double level = d.dot(sections.down) / sections.step_px;
    if (level < 0 || level >= static_cast<double>(sections.ellipses.size())) continue;
    const DepthEllipse& ellipse = sections.ellipses[static_cast<std::size_t>(level)];
    const double aside = d.dot(across) - ellipse.middle_px;
    z[v] = ellipse.round * std::sqrt(std::max(0., ellipse.half_px * ellipse.half_px - aside * aside));
  }
  return z;
}

}  // namespace skel
