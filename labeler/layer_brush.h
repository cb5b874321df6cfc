// What a stroke says that pixels of the figure are.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "libskel/layers/layer_map.h"
#include "libskel/skeleton/template.h"

namespace skel {

// The body, a limb that lies before it (LayerMap::limb), or a part that is neither.
struct LayerBrush {
  int limb = 0;
  Part part = Part::kTrunk;  // of limbs what belongs to them (limbBrush())

  bool operator==(const LayerBrush&) const = default;
};

// 0: the body.
LayerBrush limbBrush(int limb);

// All that can be painted of a body plan: the body, its limbs, then, where parts are known of it
// (knowsParts()), hair, skirt, cape and thing.
std::vector<LayerBrush> layerBrushes(const SkeletonTemplate& body_plan);

// "left arm", "skirt".
std::string brushName(const LayerBrush& brush, const SkeletonTemplate& body_plan);
// As in the pictures of layers.
std::array<std::uint8_t, 3> brushColor(const LayerBrush& brush);

// Makes all that the map says of a limb a body of its own, or leaves it on the body.
void cutOut(LayerMap& map, int limb, bool apart);

// Paints `stroke` (not 0 where it is) within `mask`; all else of the map stays. Returns whether any pixel
// changed.
bool paintPart(LayerMap& map, const Plane8& stroke, const Plane8& mask, const LayerBrush& brush);

}  // namespace skel
