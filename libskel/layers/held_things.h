// Things that a limb holds are of its body.
#pragma once

#include "libskel/layers/layer_map.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

// A connected thing of the map's parts takes the limb that most of its border inside of the figure lies
// against, if there is one.
void giveThingsToLimbs(const Silhouette& silhouette, LayerMap& map);

}  // namespace skel
