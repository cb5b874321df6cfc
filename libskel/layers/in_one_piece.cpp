#include <algorithm>

#include "libskel/layers/layer_map.h"

namespace skel {

LayerMap inOnePiece(LayerMap layers, const SkeletonTemplate& body_plan) {
  if (!layers.any()) return layers;
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int limb = static_cast<int>(k) + 1;
    if (!isLeg(body_plan, body_plan.limbs[k]) && layers.has(limb))
      layers.at_rest.push_back(limb), layers.hidden.push_back(limb);
  }
  std::sort(layers.hidden.begin(), layers.hidden.end());
  layers.limb.resize(0, 0);
  return layers;
}

}  // namespace skel
