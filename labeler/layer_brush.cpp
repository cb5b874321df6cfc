#include "labeler/layer_brush.h"

namespace skel {

LayerBrush limbBrush(int limb) { return {limb, limb >= 1 && limb <= 4 ? limbPart(limb - 1) : Part::kTrunk}; }

std::vector<LayerBrush> layerBrushes(const SkeletonTemplate& body_plan) {
  std::vector<LayerBrush> brushes;
  for (int limb = 0; limb <= static_cast<int>(body_plan.limbs.size()); ++limb)
    brushes.push_back(limbBrush(limb));
  if (knowsParts(body_plan))
    for (const Part part : {Part::kHair, Part::kSkirt, Part::kAppendix, Part::kThing})
      brushes.push_back({0, part});
  return brushes;
}

std::string brushName(const LayerBrush& brush, const SkeletonTemplate& body_plan) {
  if (brush.limb != 0) return limbName(body_plan, brush.limb);
  switch (brush.part) {
    case Part::kHair:
      return "hair";
    case Part::kSkirt:
      return "skirt";
    case Part::kAppendix:
      return "cape, wing, tail";
    case Part::kThing:
      return "thing";
    default:
      return "body";
  }
}

std::array<std::uint8_t, 3> brushColor(const LayerBrush& brush) {
  return brush.limb != 0 ? layerColor(brush.limb) : partColor(brush.part);
}

void cutOut(LayerMap& map, int limb, bool apart) {
  if (map.part.size() == 0) return;
  const auto own = static_cast<std::uint8_t>(limb);
  if (!map.any()) map.limb = Plane8::Zero(map.part.rows(), map.part.cols());
  if (apart)
    map.limb = (map.part == static_cast<std::uint8_t>(limbPart(limb - 1))).select(own, map.limb);
  else
    map.limb = (map.limb == own).select(std::uint8_t(0), map.limb);
  if (!map.limb.any()) map.limb.resize(0, 0);
}

bool paintPart(LayerMap& map, const Plane8& stroke, const Plane8& mask, const LayerBrush& brush) {
  for (Plane8* plane : {&map.limb, &map.part}) {
    if (plane->size() == 0) *plane = Plane8::Zero(mask.rows(), mask.cols());
    *plane = (mask != 0).select(*plane, Plane8::Zero(mask.rows(), mask.cols()));
  }
  const auto limb = static_cast<std::uint8_t>(brush.limb), part = static_cast<std::uint8_t>(brush.part);
  const auto painted = (stroke != 0 && mask != 0 && (map.limb != limb || map.part != part)).eval();
  if (!painted.any()) return false;
  map.limb = painted.select(limb, map.limb);
  map.part = painted.select(part, map.part);
  return true;
}

}  // namespace skel
