#include "libskel/mesh/skirt.h"

#include <algorithm>
#include <cmath>

namespace skel {

Eigen::VectorXd skirtHeights(const PlanarMesh& mesh, const DepthSkirt& skirt) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(mesh.inner_count);
  const Eigen::Vector2d across(-skirt.down.y(), skirt.down.x());
  for (int v = 0; v < mesh.inner_count; ++v) {
    const Eigen::Vector2d d = mesh.vertices[static_cast<std::size_t>(v)] - skirt.top;
    const double level = d.dot(skirt.down) / skirt.step_px;
    if (level < 0 || level >= static_cast<double>(skirt.rings.size())) continue;
    const DepthRing& ring = skirt.rings[static_cast<std::size_t>(level)];
    const double aside = d.dot(across) - ring.middle_px;
    z[v] = skirt.round * std::sqrt(std::max(0., ring.half_px * ring.half_px - aside * aside));
  }
  return z;
}

}  // namespace skel
