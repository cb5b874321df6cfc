// Distance inside the body, for skeletons that fill space.
#pragma once

#include "libskel/skin/methods.h"

namespace skel {

// From the bones to all vertices through the cubes inside the mesh (Dionne & de Lasa 2013).
SkinFunction volumetricWeights;

}  // namespace skel
