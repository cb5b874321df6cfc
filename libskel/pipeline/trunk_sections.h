// How wide a trunk is on each level, and so how deep.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "libskel/mesh/body_depth.h"

namespace skel {

// The joints of the spine, image px, and half the width of the trunk about the middle one.
struct TrunkJoints {
  Eigen::Vector2d neck, body, pelvis;
  double trunk_px = 1;
};

// Of what is seen of trunk and skirt, from the neck to the hem. `parts`: LayerMap::part, empty or of the size
// of `figure`, which is not 0 where they are told. Nothing where no trunk is seen.
std::optional<DepthSections> trunkSections(const Plane8& parts, const Plane8& figure,
                                           const TrunkJoints& joints);

}  // namespace skel
