#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <utility>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/layers/held_things.h"
#include "libskel/layers/layer_map.h"

namespace skel {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

// Those that are neither limbs nor grey.
constexpr std::array kColoured = {Part::kHair, Part::kSkirt, Part::kAppendix, Part::kThing};

// Of a limb that is one with the body; less is none of the figure.
constexpr std::uint8_t kGrownAlpha = 170, kLeastAlpha = 128, kApartAlpha = 213;

// The limb that the part is, numbered from 1; 0: none.
int limbOf(Part part) {
  for (int k = 0; k < 4; ++k)
    if (part == limbPart(k)) return k + 1;
  return 0;
}

}  // namespace

// Far apart for the first limbs; no two alike.
Rgb layerColor(int limb) {
  constexpr Rgb kFirst[] = {{150, 150, 150}, {230, 60, 60}, {50, 110, 230}, {240, 160, 30}, {40, 170, 80}};
  if (limb <= 4) return kFirst[limb];
  return {static_cast<std::uint8_t>(limb), static_cast<std::uint8_t>(255 - limb / 2), 255};
}

Rgb partColor(Part part) {
  switch (part) {
    case Part::kHair:
      return {130, 80, 40};
    case Part::kSkirt:
      return {200, 110, 200};
    case Part::kAppendix:
      return {90, 210, 210};
    case Part::kThing:
      return {60, 60, 100};
    default:
      return layerColor(0);
  }
}

std::string limbName(const SkeletonTemplate& body_plan, int limb) {
  const int end = body_plan.limbs[static_cast<std::size_t>(limb) - 1].joints[2];
  std::string name = body_plan.joints[static_cast<std::size_t>(end)].name;
  std::replace(name.begin(), name.end(), '_', ' ');
  for (const auto& [tip, whole] : {std::pair("hand", "arm"), std::pair("foot", "leg")})
    if (name.ends_with(tip)) name.replace(name.size() - 4, 4, whole);
  return name;
}

Image layerPicture(const LayerMap& layers, const Plane8& mask) {
  const auto width = static_cast<int>(mask.cols()), height = static_cast<int>(mask.rows());
  Image picture(width, height);
  picture.rgba.setZero();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (mask(y, x) == 0) continue;
      const int limb = layers.any() ? layers.limb(y, x) : 0;
      const Part part = layers.part.size() != 0 ? static_cast<Part>(layers.part(y, x)) : Part::kTrunk;
      const int grown = limb == 0 ? limbOf(part) : 0;
      const Rgb color = grown != 0                          ? layerColor(grown)
                        : limb == 0 || part == Part::kThing ? partColor(part)
                                                            : layerColor(limb);
      std::copy(color.begin(), color.end(), picture.pixel(x, y));
      picture.pixel(x, y)[3] = grown != 0 ? kGrownAlpha : 255;
    }
  return picture;
}

LayerMap layersOfPicture(const Image& picture, const Silhouette& silhouette,
                         const SkeletonTemplate& body_plan, const std::string& file) {
  const Plane8& mask = silhouette.mask;
  if (picture.width != mask.cols() || picture.height != mask.rows()) {
    std::ostringstream text;
    text << "is a layer map of " << picture.width << "x" << picture.height << " px, the image has "
         << mask.cols() << "x" << mask.rows();
    throw InputError(file, text.str());
  }
  LayerMap layers;
  layers.painted = true;
  layers.limb = layers.part = Plane8::Zero(picture.height, picture.width);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* p = picture.pixel(x, y);
      const bool grey = p[0] == p[1] && p[1] == p[2];
      if (p[3] < kLeastAlpha || grey || mask(y, x) == 0) continue;
      const auto is = [&](Part part) { return partColor(part) == Rgb{p[0], p[1], p[2]}; };
      if (const auto* part = std::find_if(kColoured.begin(), kColoured.end(), is); part != kColoured.end()) {
        layers.part(y, x) = static_cast<std::uint8_t>(*part);
        continue;
      }
      int limb = 0;
      for (int k = 1; k <= static_cast<int>(body_plan.limbs.size()) && limb == 0; ++k)
        if (layerColor(k) == Rgb{p[0], p[1], p[2]}) limb = k;
      if (limb == 0) {
        std::ostringstream text;
        text << "pixel (" << x << ", " << y << ") has the colour (" << int(p[0]) << ", " << int(p[1]) << ", "
             << int(p[2]) << "), which is no limb's; paint with the colours that --formats layers writes";
        throw InputError(file, text.str());
      }
      if (p[3] >= kApartAlpha) layers.limb(y, x) = static_cast<std::uint8_t>(limb);
      if (limb <= 4) layers.part(y, x) = static_cast<std::uint8_t>(limbPart(limb - 1));
    }
  if (!layers.limb.any()) layers.limb.resize(0, 0);
  giveThingsToLimbs(silhouette, layers);
  return layers;
}

}  // namespace skel
