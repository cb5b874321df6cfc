// Things in one piece, and of the body of the limb that holds them.
#pragma once

#include "libskel/layers/layer_map.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

// What the parts of the map call a cape or a tail, lies against nothing but a thing and is smaller than that,
// is the rest of it: a knob, the tip of a blade.
void completeThings(const Plane8& mask, Plane8& part);

// A connected thing of the map's parts takes the limb that most of its border inside of the figure lies
// against, if there is one.
void giveThingsToLimbs(const Silhouette& silhouette, LayerMap& map);

}  // namespace skel
